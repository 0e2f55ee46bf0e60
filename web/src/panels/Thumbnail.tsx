/** Pictures of objects, loaded when they come into view and kept. */

import type { ReadonlySignal } from "@preact/signals";
import { createContext } from "preact";
import { useContext, useEffect, useRef, useState } from "preact/hooks";
import { ApiFailure, type Client } from "../api/client";
import type { ObjectIndex, SceneData } from "../api/types";

/** The server renders one at a time, and browsers keep only 6 connections to it. */
const MAX_REQUESTS = 2;

const NOT_LOADED: Picture = { problem: "not loaded" };

export type Picture = { url: string } | { problem: string };

/** Loads at most a few pictures at a time; the last asked comes first, since it is in view. */
export class ThumbnailCache {
  private readonly urls = new Map<ObjectIndex, Promise<Picture>>();
  private readonly waiting: (() => void)[] = [];
  private running = 0;

  /**
   * @param missing why there is no picture of an object; empty if the server can render one.
   * @param connections counts the connections to the server: after each, a picture that was not loaded is asked again.
   */
  constructor(
    private readonly client: Client,
    private readonly missing: (object: ObjectIndex) => string,
    readonly connections: ReadonlySignal<number>,
  ) {}

  /** Returns the address of a picture, or why there is none. */
  get(object: ObjectIndex): Promise<Picture> {
    const problem = this.missing(object);
    if (problem !== "") return Promise.resolve({ problem });
    const known = this.urls.get(object);
    if (known !== undefined) return known;
    const url = new Promise<Picture>((resolve) => {
      this.waiting.push(() => {
        this.client.blob(`thumbnail/${object}.png`).then(
          (blob) => this.finish(() => resolve({ url: URL.createObjectURL(blob) })),
          (error: unknown) => this.finish(() => resolve(this.fail(object, error))),
        );
      });
    });
    this.urls.set(object, url);
    this.next();
    return url;
  }

  /** The server refuses a picture of what has no visible geometry; anything else is worth another try. */
  private fail(object: ObjectIndex, error: unknown): Picture {
    const isRefused = error instanceof ApiFailure && error.status >= 400 && error.status < 500;
    if (isRefused) return { problem: "no geometry" };
    this.urls.delete(object);
    return NOT_LOADED;
  }

  private finish(resolve: () => void): void {
    this.running--;
    resolve();
    this.next();
  }

  private next(): void {
    while (this.running < MAX_REQUESTS && this.waiting.length > 0) {
      this.running++;
      this.waiting.pop()?.();
    }
  }
}

/** Returns why the server cannot render an object; empty if it can. */
export function missingPicture({ limits, objects }: SceneData, object: ObjectIndex): string {
  if (limits.meshes !== undefined) return "box only";
  return objects.box[object] == null ? "no geometry" : "";
}

export const Thumbnails = createContext<ThumbnailCache | null>(null);

/** What was found for an object, and by which connection. */
interface Found {
  object: ObjectIndex;
  connection: number;
  picture: Picture;
}

export function Thumbnail({ object, label }: { object: ObjectIndex; label: string }) {
  const cache = useContext(Thumbnails);
  const host = useRef<HTMLDivElement>(null);
  const connection = cache?.connections.value ?? 0;
  const [found, setFound] = useState<Found | null>(null);
  const isOutdated = found?.object !== object || (found.picture === NOT_LOADED && found.connection !== connection);
  const picture = isOutdated ? null : found.picture;
  useEffect(() => {
    if (!isOutdated) return;
    let isCurrent = true;
    const observer = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      void cache?.get(object).then((loaded) => {
        if (isCurrent) setFound({ object, connection, picture: loaded });
      });
    });
    if (host.current !== null) observer.observe(host.current);
    return () => {
      isCurrent = false;
      observer.disconnect();
    };
  }, [cache, object, connection, isOutdated]);
  return (
    <div class="thumbnail" ref={host}>
      {picture !== null && "url" in picture && <img src={picture.url} alt={label} />}
      {picture !== null && "problem" in picture && <span>{picture.problem}</span>}
    </div>
  );
}

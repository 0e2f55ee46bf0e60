/** Pictures of objects, loaded when they come into view and kept. */

import { createContext } from "preact";
import { useContext, useEffect, useRef, useState } from "preact/hooks";
import type { Client } from "../api/client";
import type { ObjectIndex } from "../api/types";

const MAX_REQUESTS = 4;

/** Loads at most a few pictures at a time; the last asked comes first, since it is in view. */
export class ThumbnailCache {
  private readonly urls = new Map<ObjectIndex, Promise<string | null>>();
  private readonly waiting: (() => void)[] = [];
  private running = 0;

  constructor(private readonly client: Client) {}

  /** Returns the address of a picture, or null for an object without visible geometry. */
  get(object: ObjectIndex): Promise<string | null> {
    const known = this.urls.get(object);
    if (known !== undefined) return known;
    const url = new Promise<string | null>((resolve) => {
      this.waiting.push(() => {
        this.client.blob(`thumbnail/${object}.png`).then(
          (blob) => this.finish(() => resolve(URL.createObjectURL(blob))),
          () => this.finish(() => resolve(null)),
        );
      });
    });
    this.urls.set(object, url);
    this.next();
    return url;
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

export const Thumbnails = createContext<ThumbnailCache | null>(null);

export function Thumbnail({ object, label }: { object: ObjectIndex; label: string }) {
  const cache = useContext(Thumbnails);
  const host = useRef<HTMLDivElement>(null);
  const [url, setUrl] = useState<string | null | undefined>(undefined);
  useEffect(() => {
    setUrl(undefined);
    let isCurrent = true;
    const observer = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      void cache?.get(object).then((found) => {
        if (isCurrent) setUrl(found);
      });
    });
    if (host.current !== null) observer.observe(host.current);
    return () => {
      isCurrent = false;
      observer.disconnect();
    };
  }, [cache, object]);
  return (
    <div class="thumbnail" ref={host}>
      {typeof url === "string" && <img src={url} alt={label} />}
      {url === null && <span>no geometry</span>}
    </div>
  );
}

/** Review: the queue, the current group with its members, and the candidates. */

import type { ObjectIndex, QueueGroup, QueueOrder } from "../api/types";
import { auditText, isAuditing, showOrder, toggleAudit } from "../state/audit";
import { STATE_LABELS } from "../state/colors";
import { openConcept } from "../state/concepts";
import { classLabel, conceptLabel } from "../state/model";
import { openProposal } from "../state/proposals";
import { groupCount, reasonsForNoClass } from "../state/review";
import type { Store } from "../state/store";
import { Choice } from "./Choice";
import { Thumbnail } from "./Thumbnail";
import { VirtualList } from "./VirtualList";

const ORDERS: { id: QueueOrder; label: string }[] = [
  { id: "gain", label: "expected gain" },
  { id: "confidence", label: "least confident" },
  { id: "class", label: "class" },
  { id: "place", label: "place" },
  { id: "audit", label: "at random" },
  { id: "disagreement", label: "disagreement" },
];

/** Returns the orders that the scene allows. */
function ordersOf(store: Store): typeof ORDERS {
  const hasSecond = store.model.data.second_grounder !== "";
  return hasSecond ? ORDERS : ORDERS.filter(({ id }) => id !== "disagreement");
}

export function Review({ store }: { store: Store }) {
  const group = store.group.value;
  return (
    <div class="review">
      <QueueList store={store} />
      {group === null ? <p class="empty">{emptyText(store)}</p> : <GroupCard store={store} group={group} />}
    </div>
  );
}

/** Returns why there is no group to review. */
function emptyText(store: Store): string {
  if (store.queue.value === null) return "Loading the queue…";
  const open = store.openGroups.value.length;
  if (open === 0) return "Nothing is open here. Well done.";
  return `No open object matches the filter; ${groupCount(open)} open.`;
}

const ROW_HEIGHT = 44;

function QueueList({ store }: { store: Store }) {
  const groups = store.groups.value;
  const current = groups.findIndex((group) => group.id === store.group.value?.id);
  return (
    <div class="queue">
      <div class="queue-tools">
        <Choice
          label="Order"
          options={ordersOf(store)}
          value={store.order.value}
          onChange={(order) => showOrder(store, order)}
        />
        <button type="button" aria-pressed={isAuditing(store)} onClick={() => toggleAudit(store)}>
          Audit <kbd>V</kbd>
        </button>
        <button
          type="button"
          title={store.model.data.limits.reground ?? "Ground the open objects with what the decisions teach"}
          disabled={store.model.data.limits.reground !== undefined}
          onClick={() => store.groundAgain()}
        >
          Ground again <kbd>R</kbd>
        </button>
      </div>
      {isAuditing(store) && <p class="audit-note">{auditText(store.queue.value?.audit)}</p>}
      <VirtualList rows={groups} rowHeight={ROW_HEIGHT} role="listbox" label="Groups to review" current={current}>
        {(group: QueueGroup, index) => (
          // biome-ignore lint/a11y/useKeyWithClickEvents: arrows move in the queue from anywhere
          <div
            key={group.id}
            class="queue-row"
            role="option"
            tabIndex={-1}
            aria-selected={index === current}
            onClick={() => store.goTo(group.id)}
          >
            <span class="name">
              {group.title}
              {group.objects.length > 1 && <span class="count">{group.objects.length}</span>}
            </span>
            <span class="class-name">
              {suggestionLabel(store, group)}
              {group.is_disputed && ` ≠ ${classLabel(store.model, group.second)}`}
            </span>
            <span class="confidence">{group.confidence === null ? "" : group.confidence.toFixed(2)}</span>
          </div>
        )}
      </VirtualList>
    </div>
  );
}

/** Returns the suggested class of a group; without one also the reason: the call failed, say. */
function suggestionLabel(store: Store, group: QueueGroup): string {
  const label = classLabel(store.model, group.suggested);
  const reasons = group.suggested < 0 ? reasonsForNoClass(store.states.value, group.objects) : [];
  return [label, ...reasons.map((reason) => STATE_LABELS[reason].toLowerCase())].join(", ");
}

/** More pictures at once make each step slow. */
const MEMBERS_SHOWN = 48;

function GroupCard({ store, group }: { store: Store; group: QueueGroup }) {
  const { excluded, hiddenMembers, member, model } = store;
  const count = store.ticked.value.length;
  const first = MEMBERS_SHOWN * Math.floor(member.value / MEMBERS_SHOWN);
  const last = Math.min(first + MEMBERS_SHOWN, group.objects.length);
  const label = suggestionLabel(store, group);
  return (
    <div class={store.isGroupInFocus.value ? "group-card" : "group-card out-of-focus"}>
      <header>
        <h2>
          {group.title} <span class="arrow">→</span> {label}
        </h2>
        {store.isGroupInFocus.value ? (
          <p>
            {count} of {group.objects.length} ticked
            {hiddenMembers.value > 0 && ` · ${hiddenMembers.value} filtered out`}
            {group.confidence !== null && ` · confidence ${group.confidence.toFixed(2)}`}
            {group.objects.length > MEMBERS_SHOWN && (
              <MemberPages store={store} objects={group.objects} first={first} last={last} />
            )}
          </p>
        ) : (
          <p class="focus-note">Keys decide about the selection; Esc returns</p>
        )}
      </header>
      <div class="members" role="listbox" aria-multiselectable="true" aria-label="Members of the group">
        {group.objects.slice(first, last).map((object, offset) => (
          // biome-ignore lint/a11y/useKeyWithClickEvents: arrows and Space work from anywhere
          <div
            key={object}
            role="option"
            tabIndex={-1}
            aria-setsize={group.objects.length}
            aria-posinset={first + offset + 1}
            class={first + offset === member.value ? "member focused" : "member"}
            aria-selected={!excluded.value.has(object)}
            title={model.data.objects.path[object] ?? ""}
            onClick={() => store.select([object])}
            onDblClick={() => store.toggleMember(object)}
          >
            <Thumbnail object={object} label={model.data.objects.name[object] ?? ""} />
            <label>
              <input
                type="checkbox"
                tabIndex={-1}
                checked={!excluded.value.has(object)}
                onChange={() => store.toggleMember(object)}
              />
              <span class="name">{model.shortNames[object]}</span>
            </label>
          </div>
        ))}
      </div>
      <Actions store={store} group={group} />
    </div>
  );
}

interface MemberPagesProps {
  store: Store;
  objects: readonly ObjectIndex[];
  first: number;
  last: number;
}

function MemberPages({ store, objects, first, last }: MemberPagesProps) {
  const [before, after] = [objects[first - 1], objects[last]];
  const turn = (object: ObjectIndex | undefined) => object !== undefined && store.focus(object);
  return (
    <span class="member-pages">
      <button type="button" aria-label="Members before" disabled={before === undefined} onClick={() => turn(before)}>
        ‹
      </button>
      {first + 1} to {last}
      <button type="button" aria-label="Members after" disabled={after === undefined} onClick={() => turn(after)}>
        ›
      </button>
    </span>
  );
}

function Actions({ store, group }: { store: Store; group: QueueGroup }) {
  const targets = store.ticked.value;
  const isNone = targets.length === 0;
  return (
    <div class="actions">
      <button
        type="button"
        class="primary"
        disabled={isNone || group.suggested < 0}
        onClick={() => void store.decide(targets, "confirm")}
      >
        Confirm <kbd>Enter</kbd>
      </button>
      <button
        type="button"
        disabled={isNone}
        onClick={() => {
          store.select([]);
          store.isClassSearchOpen.value = true;
        }}
      >
        Other class <kbd>/</kbd>
      </button>
      {group.concept >= 0 && (
        <button type="button" title="All open objects of the concept, in one step" onClick={() => openConcept(store)}>
          Every {conceptLabel(store.model, group.concept)} <kbd>E</kbd>
        </button>
      )}
      <button
        type="button"
        disabled={isNone}
        title="No class is fine enough: propose a subclass"
        onClick={() => {
          store.select([]);
          openProposal(store);
        }}
      >
        Missing class <kbd>M</kbd>
      </button>
      <button type="button" disabled={isNone} onClick={() => void store.decide(targets, "no-class")}>
        No class fits <kbd>N</kbd>
      </button>
      <button type="button" disabled={isNone} onClick={() => void store.decide(targets, "unsure")}>
        Unsure <kbd>Q</kbd>
      </button>
      <button type="button" onClick={() => store.step(1)}>
        Skip <kbd>S</kbd>
      </button>
      <button type="button" onClick={() => (store.isBulkOpen.value = true)}>
        Many at once <kbd>B</kbd>
      </button>
    </div>
  );
}

/** A row of tabs; arrows, Home and End move between them. */

interface Props<T extends string> {
  tabs: readonly { id: T; label: string; count?: number }[];
  current: T;
  onChange(id: T): void;
}

export function Tabs<T extends string>({ tabs, current, onChange }: Props<T>) {
  const go = (index: number) => {
    const next = tabs[(index + tabs.length) % tabs.length];
    if (next === undefined) return;
    onChange(next.id);
    document.getElementById(`tab-${next.id}`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" data-own-keys>
      {tabs.map(({ id, label, count }, index) => (
        <button
          key={id}
          id={`tab-${id}`}
          type="button"
          role="tab"
          aria-selected={id === current}
          tabIndex={id === current ? 0 : -1}
          onClick={() => onChange(id)}
          onKeyDown={(event) => {
            if (event.key === "ArrowRight") go(index + 1);
            else if (event.key === "ArrowLeft") go(index - 1);
            else if (event.key === "Home") go(0);
            else if (event.key === "End") go(-1);
            else return;
            event.preventDefault();
          }}
        >
          {label}
          {count !== undefined && <span class="count">{count}</span>}
        </button>
      ))}
    </div>
  );
}

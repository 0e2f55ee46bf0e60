/** Asks for the access key, where the address does not carry it. */

import { useState } from "preact/hooks";

export function KeyForm({ problem, onSubmit }: { problem: string; onSubmit(key: string): void }) {
  const [key, setKey] = useState("");
  return (
    <form
      class="key-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (key !== "") onSubmit(key);
      }}
    >
      <h1>usd2kg studio</h1>
      <p>Open the address that the command printed, or type the password of this studio.</p>
      {problem !== "" && <p role="alert">{problem}</p>}
      <label>
        Password
        <input
          type="password"
          autocomplete="current-password"
          value={key}
          onInput={(event) => setKey(event.currentTarget.value)}
        />
      </label>
      <button type="submit" class="primary">
        Open
      </button>
    </form>
  );
}

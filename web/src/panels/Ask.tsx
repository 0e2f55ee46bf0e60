/** Questions in plain English, answered in a sentence with a table. */

import { useState } from "preact/hooks";
import type { AskReply } from "../api/types";
import type { Store } from "../state/store";
import { AnswerTable } from "./AnswerTable";

const EXAMPLES = [
  "what is on the table?",
  "where is the kettle?",
  "how many chairs are there?",
  "what is the heaviest thing?",
];

export function Ask({ store }: { store: Store }) {
  const [question, setQuestion] = useState("");
  const [reply, setReply] = useState<AskReply | null>(null);
  const [problem, setProblem] = useState("");
  const ask = async (text: string) => {
    if (text.trim() === "") return;
    setQuestion(text);
    setProblem("");
    try {
      const found = await store.client.post<AskReply>("ask", { question: text });
      setReply(found);
      showAnswer(store, found.objects);
    } catch (error) {
      setReply(null);
      setProblem(error instanceof Error ? error.message : String(error));
    }
  };
  return (
    <div class="ask">
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void ask(question);
        }}
      >
        <input
          type="text"
          aria-label="Question"
          placeholder="Ask about the scene"
          value={question}
          onInput={(event) => setQuestion(event.currentTarget.value)}
        />
        <button type="submit" class="primary">
          Ask
        </button>
        {EXAMPLES.map((text) => (
          <button key={text} type="button" class="chip" onClick={() => void ask(text)}>
            {text}
          </button>
        ))}
      </form>
      {problem !== "" && <p role="alert">{problem}</p>}
      {reply !== null && (
        <>
          <p class="sentence">{reply.sentence || reply.understood}</p>
          <AnswerTable store={store} {...reply} />
        </>
      )}
    </div>
  );
}

/** Shows the objects of an answer in the picture. */
export function showAnswer(store: Store, objects: readonly number[]): void {
  const found = [...new Set(objects.filter((object) => object >= 0))];
  if (found.length === 0) return;
  store.answer.value = new Set(found);
  store.colorMode.value = "answer";
  store.select(found);
  store.show(found);
}

"""ThingLists: things of a graph in tables and sentences."""

from collections.abc import Sequence

from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import agree, begin_sentence, count_phrase, join_few, name_things, the_thing
from usd2kg.errors import GraphError
from usd2kg.query import Answer
from usd2kg.query.lookup import Nouns, SceneFacts, Things

__all__ = ["ThingLists", "column_of"]


class ThingLists:
    """Finds and names the things that words mean."""

    def __init__(self, facts: SceneFacts, nouns: Nouns) -> None:
        self._facts = facts
        self._nouns = nouns

    def answer(self, things: Things, said: str = "") -> InterpretedAnswer:
        """Return the answer that lists things, with what the question says of them: that are on the table."""
        table = self.located(things.iris)
        if not things.iris:
            return InterpretedAnswer(f"all {things.text}", table, sentence=f"{begin_sentence(things.absence)}.")
        verb = "is" if len(things.iris) == 1 else "are"
        listed = f"{name_things(self._facts, things.iris)} {agree(said, len(things.iris))}".strip()
        sentence = f"There {verb} {listed}{things.suffix}."
        return InterpretedAnswer(f"all {things.text}", table, sentence=sentence)

    def check_kind(self, things: Things) -> None:
        """Check that things are of the kind that the words name; a shoe rack is not a shoe.

        Raises:
            GraphError: the words only occur in the names of other things.
        """
        if things.is_by_name:
            labels = join_few([self._facts.label(iri) for iri in things.iris])
            raise GraphError(f"not known: nothing is known to be {things.text}, which is only in the name of {labels}")

    def pair(self, kind: str) -> tuple[str, str]:
        """Return the prim paths of the two things of a kind.

        Raises:
            GraphError: there are not two.
        """
        things = self._nouns.existing(kind)
        if len(things.iris) != 2:
            raise GraphError(f"there are {len(things.iris)} {things.text}; expected two, or the names of two")
        one, other = map(self._facts.path, things.iris)
        return one, other

    def located(self, iris: Sequence[str]) -> Answer:
        """Return objects with what they are on and in."""
        facts = self._facts
        on = {iri: facts.label(anchors[0]) for iri in iris if (anchors := facts.anchors("on", iri))}
        inside: dict[str, str] = {}
        for iri in iris:
            rooms = facts.anchors("room", iri)
            containers = [anchor for anchor in facts.anchors("inside", iri) if anchor not in rooms]
            inside.update((iri, facts.label(anchor)) for anchor in (containers or rooms)[:1])
        return facts.table(facts.sorted(iris), on=on, inside=inside)

    def the(self, things: Things) -> str:
        """Return the noun phrase for things in an answer: kind and label of one, number and kind of several."""
        labels = [self._facts.label(iri) for iri in things.iris]
        if not labels:
            return things.text
        if len(labels) == 1:
            return the_thing(self._facts.kind(things.iris[0]), labels[0])
        return f"the {count_phrase(len(labels), things.text)}"


def column_of(answer: Answer, name: str) -> list[str]:
    """Return the cells of a column; empty text for unbound ones."""
    at = answer.columns.index(name)
    return [row[at] or "" for row in answer.rows]

"""Masked naming regimes hide the target's name from grounders."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.conftest import shared_file
from tests.grounding.records import neighbours_of, words_written
from tests.kitchen import kitchen_scene
from usd2kg.grounding import EVIDENCE_GROUPS, NamingRegime, ObjectView, make_grounder, view_objects
from usd2kg.grounding.context import Neighbour
from usd2kg.ontology import TBox
from usd2kg.scene import Label, Scene, SceneObject, read_scene
from usd2kg.words import words_of

MASKED = [regime for regime in NamingRegime if regime is not NamingRegime.SEMANTIC]


@pytest.fixture(scope="module", params=["demo kitchen", "IAI apartment", "AWS house", "Franka kitchen"])
def scene(request: pytest.FixtureRequest) -> Scene:
    if request.param == "demo kitchen":
        return kitchen_scene()
    return read_scene(
        shared_file(
            {
                "IAI apartment": "scenes/iai_apartment/apartment.usdc",
                "AWS house": "scenes/aws_robomaker/small_house.usdc",
                "Franka kitchen": "scenes/franka_kitchen/franka_kitchen.usdc",
            }[request.param]
        )
    )


def _texts(view: ObjectView) -> Iterator[str]:
    yield from (view.name, view.display_name, view.documentation)
    for several in (view.groups, view.siblings, view.asset, view.labels, view.materials, view.parts):
        yield from several


def _companions(view: ObjectView) -> list[Neighbour]:
    return neighbours_of(view.neighbourhood) if view.neighbourhood else []


def _neighbours(view: ObjectView) -> list[Neighbour]:
    asked: list[Neighbour] = []

    def judge(neighbour: Neighbour) -> NDArray[np.float64]:
        asked.append(neighbour)
        return np.zeros(1)

    assert view.placement is not None
    view.placement.around(judge, 48)
    return asked


def _path_of(companion: Neighbour) -> str:
    return "/".join(("", *companion.parents, companion.name))


def _in_full(word: str) -> list[tuple[str, float]]:
    """Return the only spelling of a word: unabbreviated."""
    return [(word, 0.0)]


def _renamed(scene: Scene, obj: SceneObject) -> Scene:
    """Return the scene with one object renamed, along with the paths below it."""
    path = obj.prim_path.rpartition("/")[0] + "/Zebra_77"
    changed = []
    for other in scene.objects:
        is_below = other.prim_path.startswith(obj.prim_path + "/")
        moved = path + other.prim_path.removeprefix(obj.prim_path) if is_below or other is obj else other.prim_path
        name = "Zebra_77" if other is obj else other.name
        above = path if other.parent_path == obj.prim_path else other.parent_path
        changed.append(replace(other, prim_path=moved, name=name, parent_path=above))
    return replace(scene, objects=tuple(changed))


@pytest.mark.parametrize("regime", MASKED)
def test_texts_do_not_contain_the_targets_name(scene: Scene, regime: NamingRegime) -> None:
    for obj, view in view_objects(scene, regime):
        assert obj.name not in _texts(view)
        assert obj.prim_path not in _texts(view)
        # An ancestor with the target's name (`oven/oven`) keeps it.
        above = obj.prim_path.split("/")[1:-1]
        assert view.parents.count(obj.name) <= above.count(obj.name)
        assert not (view.asset or view.materials or view.parts or view.display_name or view.documentation)
        assert view.labels == ()


@pytest.mark.parametrize("regime", MASKED)
def test_labels_stay_hidden_even_if_requested(scene: Scene, regime: NamingRegime) -> None:
    labelled = [
        replace(obj, labels=obj.labels._replace(own=(Label(obj.prim_path, "UsdSemantics", "class", obj.name),)))
        for obj in scene.objects
    ]
    labelled_scene = replace(scene, objects=tuple(labelled))
    assert all(view.labels == (obj.name,) for obj, view in view_objects(labelled_scene))
    for obj, view in view_objects(labelled_scene, regime, EVIDENCE_GROUPS):
        assert view.labels == ()
        assert obj.name not in _texts(view)


@pytest.mark.parametrize("regime", MASKED)
def test_companions_exclude_the_target_and_its_descendants(scene: Scene, regime: NamingRegime) -> None:
    paths = {obj.prim_path for obj in scene.objects}
    for obj, view in view_objects(scene, regime):
        assert (view.neighbourhood is None) == (regime is NamingRegime.OPAQUE_ANONYMOUS)
        found = [_path_of(companion) for companion in _companions(view)]
        assert obj.prim_path not in found
        # Descendants contain the target's name in their paths.
        assert not any(path.startswith(obj.prim_path + "/") for path in found)
        assert set(found) <= paths
        assert len(set(found)) == len(found)


@pytest.mark.parametrize("regime", MASKED)
def test_neighbours_exclude_the_target_and_its_descendants(scene: Scene, regime: NamingRegime) -> None:
    for obj, view in view_objects(scene, regime):
        found = ["/".join(("", *near.parents, near.name)) for near in _neighbours(view)]
        if regime is NamingRegime.OPAQUE_ANONYMOUS:
            assert set(found) <= {"/"}
        else:
            assert obj.prim_path not in found
            assert not any(path.startswith(obj.prim_path + "/") for path in found)


@pytest.mark.parametrize("regime", [NamingRegime.ABBREVIATED, NamingRegime.OPAQUE])
def test_word_counts_exclude_the_target(scene: Scene, regime: NamingRegime) -> None:
    bearers = Counter(word for obj in scene.objects for word in set(words_of(obj.name)))
    for obj, view in view_objects(scene, regime):
        assert view.neighbourhood is not None
        for word in set(words_of(obj.name)):
            others = bearers[word] - 1
            expected = [(word, others / len(scene.objects), 0.0)] if others else []
            assert words_written(view.neighbourhood, word, _in_full) == expected


@pytest.mark.parametrize("regime", [NamingRegime.OPAQUE, NamingRegime.OPAQUE_ANONYMOUS])
def test_renaming_the_target_changes_nothing(scene: Scene, regime: NamingRegime, home_tbox: TBox) -> None:
    grounder = make_grounder("lexical")
    for at in range(0, len(scene.objects), max(1, len(scene.objects) // 8)):
        renamed = _renamed(scene, scene.objects[at])
        (_, before), (other, after) = (list(view_objects(whole, regime))[at] for whole in (scene, renamed))
        assert other.name == "Zebra_77"
        assert _companions(before) == _companions(after)
        assert list(before.siblings) == list(after.siblings)
        assert _neighbours(before) == _neighbours(after)
        assert before.appearance == after.appearance
        ignored = {"neighbourhood": None, "siblings": (), "placement": None}
        assert replace(before, **ignored) == replace(after, **ignored)
        one, two = (grounder.ground_views([("/x", view)], home_tbox) for view in (before, after))
        assert one == two


@pytest.mark.parametrize("regime", MASKED)
def test_siblings_are_all_other_children_of_the_parent(scene: Scene, regime: NamingRegime) -> None:
    families: dict[str, list[str]] = {}
    for obj in scene.objects:
        families.setdefault(obj.prim_path.rpartition("/")[0], []).append(obj.name)
    for obj, view in view_objects(scene, regime):
        family = families[obj.prim_path.rpartition("/")[0]]
        if regime is NamingRegime.OPAQUE_ANONYMOUS:
            assert not set(view.siblings) & set(family)
            assert len(view.siblings) == len(family) - 1
        else:
            others = list(family)
            others.remove(obj.name)
            assert list(view.siblings) == others


def test_anonymous_ancestors_hide_all_names(scene: Scene) -> None:
    names = {part for obj in scene.objects for part in obj.prim_path.split("/") if part}
    for _, view in view_objects(scene, NamingRegime.OPAQUE_ANONYMOUS):
        assert not names & {*view.parents, *view.groups, *view.siblings, view.name}


@pytest.mark.parametrize("regime", MASKED)
@pytest.mark.parametrize("name", ["lexical", "dictionary"])
def test_predictions_do_not_depend_on_the_batch(scene: Scene, regime: NamingRegime, name: str, home_tbox: TBox) -> None:
    """The sibling lists together contain every name, so a grounder must not carry state between targets."""
    views = [(obj.prim_path, view) for obj, view in view_objects(scene, regime)][:60]
    together = make_grounder(name).ground_views(views, home_tbox)
    grounder = make_grounder(name)
    alone = [grounder.ground_views([pair], home_tbox)[0] for pair in views[::12]]
    assert alone == together[::12]
    assert make_grounder(name).ground_views(views[::-1], home_tbox)[::-1] == together
    # Views that share one stage context and views built separately are equivalent.
    anew = [(obj.prim_path, view) for obj, view in view_objects(scene, regime)][:60:12]
    assert make_grounder(name).ground_views(anew, home_tbox) == alone

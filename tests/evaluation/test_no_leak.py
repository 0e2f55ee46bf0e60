"""Under a masked regime nothing that a grounder is given tells the target's own name."""

from collections.abc import Iterator

import pytest

from tests.conftest import shared_file
from usd2kg.demo import demo_scene
from usd2kg.grounding import make_grounder
from usd2kg.ontology import TBox
from usd2kg.scene import NamingRegime, ObjectView, Scene, read_scene, view_objects

MASKED = [regime for regime in NamingRegime if regime is not NamingRegime.SEMANTIC]


@pytest.fixture(scope="module", params=["demo kitchen", "IAI apartment", "AWS house", "Franka kitchen"])
def scene(request: pytest.FixtureRequest) -> Scene:
    if request.param == "demo kitchen":
        return read_scene(demo_scene())
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
    for several in (view.groups, view.siblings, view.asset, view.materials, view.parts):
        yield from several


@pytest.mark.parametrize("regime", MASKED)
def test_no_text_of_a_view_is_the_target_s_name(scene: Scene, regime: NamingRegime) -> None:
    for obj, view in view_objects(scene, regime):
        assert obj.name not in _texts(view)
        assert obj.prim_path not in _texts(view)
        # An ancestor may bear the same name as the target (`oven/oven`): that is its own name, which it keeps.
        above = obj.prim_path.split("/")[1:-1]
        assert view.parents.count(obj.name) <= above.count(obj.name)
        assert not (view.asset or view.materials or view.parts or view.display_name or view.documentation)


@pytest.mark.parametrize("regime", MASKED)
def test_siblings_are_the_others_and_all_the_others(scene: Scene, regime: NamingRegime) -> None:
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


def test_anonymous_parents_tell_nothing(scene: Scene) -> None:
    names = {part for obj in scene.objects for part in obj.prim_path.split("/") if part}
    for _, view in view_objects(scene, NamingRegime.OPAQUE_ANONYMOUS):
        assert not names & {*view.parents, *view.groups, *view.siblings, view.name}


@pytest.mark.parametrize("regime", MASKED)
@pytest.mark.parametrize("name", ["embedded", "dictionary"])
def test_a_batch_gives_nothing_that_one_target_alone_does_not(
    scene: Scene, regime: NamingRegime, name: str, home_tbox: TBox
) -> None:
    """The union of all siblings' lists holds every name: a grounder that remembers across targets would cheat."""
    views = [(obj.prim_path, view) for obj, view in view_objects(scene, regime)][:60]
    together = make_grounder(name).ground_views(views, home_tbox)
    grounder = make_grounder(name)
    alone = [grounder.ground_views([pair], home_tbox)[0] for pair in views[::12]]
    assert alone == together[::12]
    assert make_grounder(name).ground_views(views[::-1], home_tbox)[::-1] == together

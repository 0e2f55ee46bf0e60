"""Merge an included model into the model that includes it."""

from dataclasses import replace

from usd2kg.convert.sdf.frames import MODEL_FRAME, Scope
from usd2kg.convert.sdf.model import Model, Pose, SdfFrame, SdfJoint, SdfLink, SdfWorld
from usd2kg.convert.sdf.notes import Notes

__all__ = ["merge_models"]


def merge_models(model: Model, merged: Model, notes: Notes) -> Model:
    """Return a model with the links, joints, frames and models of an include with `merge`.

    What was relative to the merged model becomes relative to a frame that has its pose (SDFormat 1.9, "Merge-include").
    """
    frame_name = f"_merged__{merged.name}{MODEL_FRAME}"
    alone = replace(merged, pose=Pose(merged.pose.matrix))
    placed = Scope(SdfWorld("", (alone,)), notes, model.path).place_model(alone)
    first = merged.canonical_link or next((link.name for link in merged.links), "")
    frame = SdfFrame(frame_name, Pose(placed, merged.pose.relative_to or MODEL_FRAME), first)

    def renamed(name: str) -> str:
        return frame_name if name == MODEL_FRAME else name

    def moved(pose: Pose, *, has_default: bool = False) -> Pose:
        return Pose(pose.matrix, renamed(pose.relative_to or ("" if has_default else MODEL_FRAME)))

    def moved_link(link: SdfLink) -> SdfLink:
        visuals = tuple(replace(visual, pose=moved(visual.pose, has_default=True)) for visual in link.visuals)
        center = link.center_of_mass and moved(link.center_of_mass, has_default=True)
        return replace(link, pose=moved(link.pose), visuals=visuals, center_of_mass=center)

    def moved_joint(joint: SdfJoint) -> SdfJoint:
        axis = joint.axis and replace(joint.axis, expressed_in=renamed(joint.axis.expressed_in))
        pose = moved(joint.pose, has_default=True)
        return replace(joint, pose=pose, parent=renamed(joint.parent), child=renamed(joint.child), axis=axis)

    def moved_frame(inner: SdfFrame) -> SdfFrame:
        attached_to = renamed(inner.attached_to or MODEL_FRAME)
        return replace(inner, pose=moved(inner.pose, has_default=True), attached_to=attached_to)

    return replace(
        model,
        asset=model.asset or merged.asset,
        links=(*model.links, *map(moved_link, merged.links)),
        joints=(*model.joints, *map(moved_joint, merged.joints)),
        frames=(*model.frames, frame, *map(moved_frame, merged.frames)),
        models=(*model.models, *(replace(inner, pose=moved(inner.pose)) for inner in merged.models)),
    )

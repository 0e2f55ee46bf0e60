"""The kitchenette in the back room."""

import numpy as np

from benchmarks.scenes.salon import furniture, things
from benchmarks.scenes.salon.contact import heights_below
from benchmarks.scenes.salon.rooms import at_wall, hang
from benchmarks.scenes.salon.shapes import Shape, bent, cuboid, disc, hollow_box, merge, move, turn, vessel
from benchmarks.scenes.salon.shared import CUP, MAGNET, NOTE, PLATE, SAUCER, SHAMPOO, SPOON, TAP
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["build_kitchenette"]

PULL = Asset("pull", furniture.pull(0.13))
DOOR = Asset("cabinet_door", furniture.door_leaf(0.597, 0.7))
WALL_DOOR = Asset("wall_cabinet_door", furniture.door_leaf(0.597, 0.64))


def build_kitchenette(salon: Salon) -> None:
    """Add everything in and around the kitchenette."""
    _build_kitchenette(salon)
    _fill_cabinets(salon)
    _fill_worktop(salon)


def _add_doors(
    salon: Salon,
    name: str,
    door: Asset,
    hinges: tuple[float, float],
    face: float,
    z: float,
    handle: float,
    opened: float,
) -> None:
    """Add a pair of doors at the south wall; the second is open by an angle."""
    # Seen from the room, the first hinge is at the higher x, since fronts look north.
    salon.put(f"{name}/Door_1", door, (hinges[0], face, z), 180)
    salon.put(f"{name}/Pull_1", PULL, (hinges[0] - 0.55, face + 0.018, z + handle), 180)
    mirrored = Asset(f"{door.name}_2", move(door.shape, x=-0.597))
    salon.put(f"{name}/Door_2", mirrored, (hinges[1], face, z), 180 + opened)
    grip = turn(Shape(np.array([[-0.55, -0.018, 0.0]]), []), "z", 180 + opened).points[0]
    salon.put(f"{name}/Pull_2", PULL, (hinges[1] + grip[0], face + grip[1], z + handle), 180 + opened)


def _build_kitchenette(salon: Salon) -> None:
    name, wall = "Back/Kitchenette", "back south"
    salon.rest(
        f"{name}/Base/Cabinet",
        Asset("base_cabinet", furniture.carcass(1.2, 0.56, 0.8, (0.42,), top=False)),
        at_wall(wall, 7.2, 0.29),
        "Building/Floor",
        yaw=180,
    )
    _add_doors(salon, f"{name}/Base", DOOR, (7.798, 6.602), 0.572, 0.06, 0.55, 0.0)
    top = Asset("worktop", furniture.worktop(1.24, 0.6, 0.04, (-0.5, -0.06, -0.22, 0.14)))
    salon.rest(f"{name}/Worktop", top, at_wall(wall, 7.2, 0.3), f"{name}/Base/Cabinet", yaw=180)
    salon.rest(
        f"{name}/Sink", Asset("sink", furniture.sink(0.42, 0.34, 0.16)), (7.48, 0.34), f"{name}/Worktop", yaw=180
    )
    salon.rest(f"{name}/Tap", TAP, (7.48, 0.08), f"{name}/Worktop", yaw=180)
    bottom = float(salon.objects[f"{name}/Sink"].solid.points[:, 2].min())
    trap = [(0, 0, 0), (0, 0, -0.12), (0.04, 0, -0.17), (0.08, 0, -0.12), (0.1, 0, -0.08), (0.1, -0.26, -0.08)]
    salon.put(
        f"{name}/Drain_pipe", Asset("drain_pipe", bent([(a, b, c) for a, b, c in trap], 0.018)), (7.48, 0.34, bottom)
    )
    salon.put(
        f"{name}/Wall_cabinet/Cabinet",
        Asset("wall_cabinet", furniture.carcass(1.2, 0.32, 0.65, (0.33,))),
        (7.2, 0.162, 1.45),
        180,
    )
    _add_doors(salon, f"{name}/Wall_cabinet", WALL_DOOR, (7.798, 6.602), 0.324, 1.455, 0.1, 75.0)
    hang(salon, f"{name}/Towel_hook", Asset("single_hook", furniture.hook_rail(0.06, 1)), wall, 8.0, 1.2)
    salon.put(f"{name}/Tea_towel", Asset("tea_towel", things.draped(0.28, 0.5, 0.42, 0.007)), (8.0, 0.05, 1.19), 180)
    salon.rest(f"{name}/Fridge", salon.model("KatorLegaz/fridge"), at_wall(wall, 8.45, 0.33), "Building/Floor", yaw=180)
    fridge = salon.objects[f"{name}/Fridge"].solid
    # With y and z exchanged, the door is what is highest.
    spot = np.array([[8.4, 1.0, 0.0]])
    front = float(heights_below(spot, fridge._replace(points=fridge.points[:, [0, 2, 1]]), np.inf)[0])
    salon.put(f"{name}/Fridge_note", NOTE, (8.4, front + 0.002, 0.95), 180)
    salon.put(f"{name}/Fridge_magnet_1", MAGNET, (8.4, front + 0.003, 1.0), 180)
    salon.put(f"{name}/Fridge_magnet_2", MAGNET, (8.3, front + 0.001, 0.85), 180)
    salon.rest(
        f"{name}/Fridge_basket",
        salon.model("Scopia/shopping-basket"),
        at_wall(wall, 8.45, 0.3),
        f"{name}/Fridge",
        yaw=90,
    )


def _fill_cabinets(salon: Salon) -> None:
    name = "Back/Kitchenette"
    base, wall = f"{name}/Base/Cabinet", f"{name}/Wall_cabinet/Cabinet"
    salon.rest(f"{name}/Bucket", Asset("bucket", things.bucket(0.13, 0.25)), (7.48, 0.3), base, below=0.1)
    for number, x in enumerate((6.75, 6.87, 6.98), 1):
        salon.rest(f"{name}/Cleaner_{number}", SHAMPOO, (x, 0.3 + 0.02 * number), base, below=0.1)
    salon.rest(
        f"{name}/Sponge_box",
        Asset("sponge_box", hollow_box(0.3, 0.22, 0.12, 0.004)),
        (6.95, 0.32),
        base,
        yaw=184,
        below=0.5,
    )
    sponge = Asset("sponge", cuboid(0.1, 0.07, 0.035))
    salon.rest(f"{name}/Sponge_1", sponge, (6.9, 0.32), f"{name}/Sponge_box", yaw=10)
    salon.rest(f"{name}/Sponge_2", sponge, (6.91, 0.325), f"{name}/Sponge_1", yaw=25)
    salon.rest(f"{name}/Plate_1", PLATE, (6.85, 0.165), wall, below=1.5)
    for number in range(2, 6):
        salon.rest(f"{name}/Plate_{number}", PLATE, (6.85 + 0.001 * number, 0.165), f"{name}/Plate_{number - 1}")
    salon.rest(f"{name}/Saucer_1", SAUCER, (7.08, 0.17), wall, below=1.5)
    salon.rest(f"{name}/Saucer_2", SAUCER, (7.08, 0.171), f"{name}/Saucer_1")
    for number, x in enumerate((7.25, 7.38, 7.5), 1):
        salon.rest(f"{name}/Cup_{number}", CUP, (x, 0.16), wall, yaw=50 * number, below=1.5)
    salon.rest(f"{name}/Cup_4", CUP, (7.252, 0.161), f"{name}/Cup_1", yaw=20)
    salon.rest(f"{name}/Sugar", salon.model("Scopia/sugar"), (6.85, 0.16), wall, below=1.8)
    salon.rest(f"{name}/Teapot", salon.model("Scopia/teapot"), (7.1, 0.16), wall, yaw=190, below=1.8)
    salon.rest(f"{name}/Coffee_tin", Asset("coffee_tin", disc(0.05, 0.17)), (7.35, 0.16), wall, below=1.8)
    salon.rest(f"{name}/Biscuit_tin", Asset("biscuit_tin", vessel(0.09, 0.09, 0.08, 0.002)), (7.6, 0.16), f"{wall}")
    salon.rest(
        f"{name}/Biscuit_tin_lid",
        Asset(
            "tin_lid",
            merge(disc(0.093, 0.003, 0.012), *(move(cuboid(0.002, 0.05, 0.012), x=s * 0.092) for s in (-1, 1))),
        ),
        (7.6, 0.16),
        f"{name}/Biscuit_tin",
    )


def _fill_worktop(salon: Salon) -> None:
    name = "Back/Kitchenette"
    top = f"{name}/Worktop"
    salon.rest(f"{name}/Kettle", Asset("kettle", things.kettle()), (6.72, 0.2), top, yaw=140)
    salon.rest(f"{name}/Coffee_maker", salon.model("KatorLegaz/coffee-maker"), (6.95, 0.15), top, yaw=180)
    salon.rest(f"{name}/Dish_rack", Asset("dish_rack", things.dish_rack()), (7.04, 0.43), top, yaw=3)
    rack = salon.objects[f"{name}/Dish_rack"].solid.points
    for number, dx in enumerate((-0.115, -0.035, 0.045), 1):
        salon.put(
            f"{name}/Rack_plate_{number}", PLATE, (7.04 + dx, 0.43, float(rack[:, 2].min()) + 0.139), 3, ("y", 83)
        )
    salon.rest(f"{name}/Rack_cup", CUP, (7.18, 0.43), f"{name}/Dish_rack", tilt=("x", 180))
    salon.rest(f"{name}/Sink_cup", CUP, (7.35, 0.38), f"{name}/Sink", yaw=33)
    salon.rest(f"{name}/Sink_plate", PLATE, (7.56, 0.34), f"{name}/Sink")
    salon.rest(f"{name}/Sink_spoon", SPOON, (7.56, 0.34), f"{name}/Sink_plate", yaw=80)
    salon.rest(f"{name}/Dish_soap", Asset("soap_pump", things.soap_pump()), (7.72, 0.1), top, yaw=200)
    salon.rest(f"{name}/Wet_sponge", Asset("sponge", cuboid(0.1, 0.07, 0.035)), (7.75, 0.3), top, yaw=80)

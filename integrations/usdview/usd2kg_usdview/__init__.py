"""Plugin of usdview that colours the stage by class and shows what usd2kg knows about an object."""

from importlib.util import find_spec

# The modules without Qt are also usable, and tested, where usdview is not installed.
if find_spec("pxr.Usdviewq") is not None:
    from pxr import Tf

    from usd2kg_usdview.container import Usd2kgPluginContainer

    # usdview finds containers by their Tf type.
    Tf.Type.Define(Usd2kgPluginContainer)

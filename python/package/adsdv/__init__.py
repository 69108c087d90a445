# What is in it is compiled; the module is a package so that it can have a plugin of pytest beside it.
from . import _adsdv
from ._adsdv import *  # noqa: F403

__doc__ = _adsdv.__doc__
__all__ = _adsdv.__all__

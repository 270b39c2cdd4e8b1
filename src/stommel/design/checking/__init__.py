"""One honest check of a vehicle file: every number that another number of the file speaks about is held against it."""

from stommel.design.checking.cross_check import CHECKS, CrossCheck, cross_check

__all__ = ["CHECKS", "CrossCheck", "cross_check"]

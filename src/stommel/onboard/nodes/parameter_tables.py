"""Parameters of both nodes by their numbers: what names, types and units a coordinator knows without asking."""

from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.parameters import Parameter
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import parameters_of

PARAMETERS: dict[int, tuple[Parameter, ...]] = {
    MOTION: tuple(parameters_of(MotionSettings())),
    ACQUISITION: tuple(parameters_of(AcquisitionSettings())),
}
"""By number of the node. Defaults and limits are those of the paper's vehicle: a node's own must be asked for."""

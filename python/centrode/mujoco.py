"""Models for MuJoCo that follow the laws of a machine; install it with ``pip install mujoco``.

The model is the one that `export` writes, and the laws are those of its `motion.json` and `motion.csv`.
"""

# mypy: disable-error-code="import-untyped, import-not-found"
from __future__ import annotations

import io
import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _machine
from ._error import DesignError
from ._need import need

if TYPE_CHECKING:
    import mujoco as _mj
    from numpy import float64, intp
    from numpy.typing import NDArray

    from ._centrode import Mechanism

__all__ = ["Control", "load"]


def load(
    of: Mechanism, *, speed: float | None = None, contact: bool = False, tolerance: float = 1e-2
) -> tuple[_mj.MjModel, Control]:
    """Make the model of a machine and the control that moves it by its laws.

    Args:
        of: A machine of any family.
        speed: Speed of the input, rad/s; default: that of the design. Negative: backwards.
        contact: Whether contact between bodies is computed. It is not needed if all bodies move by their laws, and
            steps are faster without it.
        tolerance: Maximum distance of the meshes from the exact solids, mm.

    Returns:
        The model and its control. Pass the control to `mujoco.set_mjcb_control`, or call its `step`.
    """
    mujoco = need("mujoco", "mujoco")
    files = _machine.machine(of).files(formats=["mjcf"], tolerance=tolerance)
    about = json.loads(files["motion.json"])
    table = np.genfromtxt(io.BytesIO(files[about["table"]]), delimiter=",", names=True)
    wanted = about["input"]["speed_rad_per_s"] if speed is None else float(speed)
    if not math.isfinite(wanted):
        raise DesignError(f"speed must be a finite number, not {wanted}", "speed")
    meshes = {name: contents for name, contents in files.items() if name.endswith(".stl")}
    model = mujoco.MjModel.from_xml_string(files[about["models"][1]].decode(), meshes)
    if not contact:
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    return model, _control(model, about, table, wanted)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Control:
    """Forces that keep every joint of a model on its law, by inverse dynamics.

    MuJoCo calls it with model and data at every step. It sets `qfrc_applied` so that each joint is at the position of
    its law at the end of the step. The input has constant speed, and is zero at time zero. The integrator of the model
    must be Euler's, as in the model file.
    """

    joints: tuple[str, ...]
    """Names of the joints, as in the model."""
    speed: float
    """Speed of the input, rad/s."""
    period: float
    """Input after which every law repeats, apart from its advance, rad."""
    _places: NDArray[float64]
    _rates: NDArray[float64]
    _advances: NDArray[float64]
    _qpos: NDArray[intp]
    _dofs: NDArray[intp]

    def law(self, travel: float) -> tuple[NDArray[float64], NDArray[float64]]:
        """Positions of the joints at an input `travel`, rad or m, and their rates with respect to it.

        Values between the rows of the table are by cubic Hermite interpolation, as stated in `motion.json`.
        """
        steps = self._places.shape[1] - 1
        step = self.period / steps
        whole, rest = divmod(travel, self.period)
        row = min(int(rest / step), steps - 1)
        x = rest / step - row
        a, b = self._places[:, row], self._places[:, row + 1]
        va, vb = self._rates[:, row], self._rates[:, row + 1]
        place = (1 + 2 * x) * (1 - x) ** 2 * a + x * x * (3 - 2 * x) * b + step * x * (1 - x) * ((1 - x) * va - x * vb)
        rate = 6 * x * (1 - x) * (b - a) / step + (1 - x) * (1 - 3 * x) * va + x * (3 * x - 2) * vb
        return place + whole * self._advances, rate

    def place(self, model: _mj.MjModel, data: _mj.MjData) -> None:
        """Set every joint to the position and the rate of its law at the time of the data."""
        place, rate = self.law(self.speed * data.time)
        data.qpos[self._qpos], data.qvel[self._dofs] = place, self.speed * rate
        need("mujoco", "mujoco").mj_forward(model, data)

    def off(self, data: _mj.MjData) -> dict[str, float]:
        """Deviation of each joint from its law at the time of the data, rad or m."""
        place, _ = self.law(self.speed * data.time)
        return dict(zip(self.joints, (data.qpos[self._qpos] - place).tolist(), strict=True))

    def step(self, model: _mj.MjModel, data: _mj.MjData, count: int = 1) -> None:
        """Simulate some steps, without a callback, which would apply to all models of the process."""
        mujoco = need("mujoco", "mujoco")
        for _ in range(count):
            mujoco.mj_step1(model, data)
            self(model, data)
            mujoco.mj_step2(model, data)

    def __call__(self, model: _mj.MjModel, data: _mj.MjData) -> None:
        """Set the forces of the step that begins at the time of the data."""
        mujoco = need("mujoco", "mujoco")
        if model.opt.integrator != mujoco.mjtIntegrator.mjINT_EULER:
            raise ValueError("the integrator of the model must be Euler's: the forces are computed for its step")
        step = model.opt.timestep
        wanted, _ = self.law(self.speed * (data.time + step))
        # Euler's method makes the new rate first, then the new position by it.
        rate = (wanted - data.qpos[self._qpos]) / step
        data.qacc[self._dofs] = (rate - data.qvel[self._dofs]) / step
        mujoco.mj_inverseSkip(model, data, mujoco.mjtStage.mjSTAGE_VEL, 1)
        data.qfrc_applied[self._dofs] = data.qfrc_inverse[self._dofs]

    def __repr__(self) -> str:
        """Joints and speed."""
        return f"Control({len(self.joints)} joints, speed={self.speed!r})"


def _control(model: Any, about: dict[str, Any], table: NDArray[Any], speed: float) -> Control:
    """The control of a model by a table of motion and its description."""
    period, advance = about["input"]["period_rad"], {column["name"]: column["advance"] for column in about["columns"]}
    joints = about["joints"]
    rates = []
    for joint in joints:
        if joint["rate"] is None:
            even = joint["factor"] * advance[joint["column"]] / period
            rates.append(np.full(len(table), even))
        else:
            rates.append(joint["rate_factor"] * table[joint["rate"]])
    names = tuple(joint["name"] for joint in joints)
    found = [model.joint(name) for name in names]
    return Control(
        joints=names,
        speed=speed,
        period=period,
        _places=np.array([joint["factor"] * table[joint["column"]] + joint["offset"] for joint in joints]),
        _rates=np.array(rates),
        _advances=np.array([joint["factor"] * advance[joint["column"]] for joint in joints]),
        _qpos=np.array([joint.qposadr[0] for joint in found]),
        _dofs=np.array([joint.dofadr[0] for joint in found]),
    )

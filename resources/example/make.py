"""Make the example case that comes with the product: ``python resources/example/make.py``.

A right foot, simulated and reconstructed like a patient's, and a finished insole for it: a device
of the product with a pelott and four degrees at the rearfoot.
"""

from __future__ import annotations

import hashlib
import tempfile
from pathlib import Path

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.reconstruct import reconstruct
from insole_core.recording.session import Session
from insole_core.recording.writer import write_session
from insole_core.resources import resource_path
from insole_core.simulate import SimulationOptions, simulate_session

SEED = 21
DEVICE = "devices/eva-full-length.json"


def main() -> None:
    """Simulate, reconstruct, prescribe, write."""
    simulated = simulate_session(SimulationOptions(seed=SEED, side=Side.RIGHT, distance_mm=700))
    foot = place_foot(reconstruct(simulated.session).mesh, Side.RIGHT, frame="reference")
    pelott = Pelott(id="pelott", centre_mm=(-3.0, 0.605 * foot.length_mm))
    posting = Posting(id="posting", rearfoot_deg=4.0)
    patient = Patient("Example, Anna", "1971-04-02", "2026-11-20", "Forefoot pain when walking.")
    device = read_device(resource_path(DEVICE))
    design = apply_device(device, InsoleDesign(Side.RIGHT, (pelott, posting)))
    begun = FootRecord.begun(foot, _source(simulated.session), design)
    record = CaseRecord.of_foot(begun, patient)
    write_case(record, Path(__file__).with_name("example.insole"))


def _source(session: Session) -> ScanSource:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.zip"
        write_session(session, path)
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return ScanSource("session", "example.zip", digest, session.manifest.recorded_at)


if __name__ == "__main__":
    main()

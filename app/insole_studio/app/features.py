"""All features of the program and the actions that each contributes."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.mesh import TriangleMesh
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.document.autosave import Autosave
from insole_studio.features.calibrate.calibrate_window import CalibrateWindow
from insole_studio.features.capture.capture_window import CaptureWindow
from insole_studio.features.case_files.case_files import CaseFiles, make_case_files
from insole_studio.features.clinic.clinic_administration import ClinicAdministration
from insole_studio.features.compare.compare_window import CompareWindow
from insole_studio.features.design.design import Design, make_design
from insole_studio.features.design.stage import DesignStage
from insole_studio.features.export.export_actions import ExportActions
from insole_studio.features.foot.foot_window import FootWindow
from insole_studio.features.import_scan.scan_import import ScanImport
from insole_studio.features.records.patient_records import PatientRecords
from insole_studio.services.app_services import AppServices


@dataclass(frozen=True, eq=False)
class Features:
    """One object per feature; features are independent, the main controller connects them."""

    records: PatientRecords
    clinic: ClinicAdministration
    case_files: CaseFiles
    capture: CaptureWindow
    foot: FootWindow
    design: Design
    export: ExportActions
    compare: CompareWindow
    calibrate: CalibrateWindow

    def close_windows(self) -> None:
        """Close the windows of all features."""
        for feature in (self.capture, self.calibrate, self.export, self.compare, self.foot):
            feature.close()
        self.clinic.close()


def make_features(
    services: AppServices, stage: DesignStage, autosave: Autosave, source: SensorSource
) -> Features:
    """Construct every feature; the windows of stages are created when they are opened."""
    foot = FootWindow(services)
    case_files = make_case_files(services, autosave, foot.open_session, ScanImport(services).open)

    def drawn() -> TriangleMesh | None:
        return stage.preview.mesh if stage.preview.is_current else None

    return Features(
        records=PatientRecords(services, case_files.saver.after_unsaved),
        clinic=ClinicAdministration(services, case_files.saver.after_unsaved, autosave.keep_now),
        case_files=case_files,
        capture=CaptureWindow(services, source),
        foot=foot,
        design=make_design(services, stage),
        export=ExportActions(services, drawn, stage.load.told_on_papers),
        compare=CompareWindow(services),
        calibrate=CalibrateWindow(services.paths, source, services.messages, services.window),
    )

"""Take the pictures of the documentation: ``make pictures``, under Xvfb.

The feet are those of one simulated person: the right one is the bundled example, the left one is
simulated here. `dialog_pictures` lists all pictures; journeys of the tests take some of them.

With ``--journeys FOLDER`` it takes none of these, but walks the journeys of the manual by real
events, and saves what is on the screen at each step, and a contact sheet, to be looked at:

    QT_QPA_PLATFORM=xcb xvfb-run -a -s "-screen 0 3840x2160x24" \\
        python docs/pictures.py --journeys FOLDER --size 3840x2160 --language sv --theme dark
"""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from contact_sheet import write_sheet
from device_pictures import draw_devices
from dialog_pictures import SCAN, fill_record, open_record, save, take_and_close, take_dialogs
from hand import HANDS
from journeys import JOURNEYS, SCALED, Circumstances, walk
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QPainter, QPen

from insole_core.cases.case_file import read_case
from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.pressure.alignment import SolePrint
from insole_core.recording.hand_edits import HandEdits, ViewEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.recording.writer import write_session
from insole_core.resources import resource_path
from insole_core.simulate import SimulationOptions, simulate_session
from insole_studio.app.scripted import ScriptedWindow, grab, grab_window
from insole_studio.features.design.load.load_dialog import LoadDialog
from insole_studio.features.design.plantar.plantar_dialogs import PressureDialog
from insole_studio.features.foot.rows import FootMap
from insole_studio.features.foot.stage import FootStage
from insole_studio.languages import LANGUAGES, Language
from insole_studio.settings import Settings, save_settings
from insole_studio.texts import translation_into
from insole_studio.user_paths import UserPaths

IMAGES = Path(__file__).parent / "manual" / "images"
"""Those of the English manual; each other language has a folder in it."""
VARIANT = {"en": "higher pad", "sv": "högre pelott"}
EXAMPLE = resource_path("example/example.insole")
SEED = 21
"""That of the example."""
SMALL, LARGE = (1366, 768), (1600, 900)
STAGE = (1366, 730)
BORDER = 24
"""Above and below a window that stands over the main one, px."""
NOT_A_MARKER = ((460.0, 665.0), (550.0, 665.0), (550.0, 750.0), (460.0, 750.0))
"""Round something blue in the left view, colour px."""
EDITS = HandEdits(
    {"left": ViewEdits(excluded=("S3",), ignored=(NOT_A_MARKER,)), "top": ViewEdits(off=True)}
)


def main() -> None:
    """Take them all, or walk the journeys."""
    arguments = parsed()
    if arguments.journeys is None:
        for language in LANGUAGES:
            take_documentation(language)
    else:
        take_journeys(arguments)


def parsed() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description="Take the pictures of the documentation.")
    parser.add_argument("--journeys", type=Path, metavar="FOLDER")
    parser.add_argument("--size", default="1366x768", help="of the screen")
    parser.add_argument("--scale", type=float, help="by default 1; 2 on a screen of 3840x2160")
    parser.add_argument("--journey", nargs="*", choices=tuple(JOURNEYS), default=tuple(JOURNEYS))
    parser.add_argument("--language", choices=list(LANGUAGES), default="en")
    parser.add_argument("--theme", choices=("light", "dark"), default="light")
    parser.add_argument("--hand", choices=tuple(HANDS), default="mouse")
    return parser.parse_args()


def take_journeys(arguments: argparse.Namespace) -> None:
    """Walk the journeys in the circumstances asked for."""
    folder: Path = arguments.journeys
    folder.mkdir(parents=True, exist_ok=True)
    session = folder / "left_foot.zip"
    if not session.exists():
        simulate_left_foot(session)
    width, height = (int(text) for text in arguments.size.split("x"))
    scale = arguments.scale or (2.0 if (width, height) == SCALED else 1.0)
    circumstances = Circumstances(
        (width, height), arguments.language, arguments.theme, arguments.hand, scale
    )
    pictures = walk(circumstances, session, folder, arguments.journey)
    write_sheet(pictures, folder / f"{circumstances.name}.png")


def simulate_left_foot(session: Path) -> None:
    """Simulate a scan of the other foot of the example's patient."""
    simulated = simulate_session(SimulationOptions(seed=SEED, side=Side.LEFT, distance_mm=700))
    write_session(simulated.session, session)


def take_documentation(language: Language) -> None:
    """Take the pictures of the documentation in a language."""
    images = images_of(language)
    with tempfile.TemporaryDirectory() as folder:
        paths, of_clinic = (user(Path(folder) / name, language) for name in ("window", "clinic"))
        session = Path(folder) / "left_foot.zip"
        simulate_left_foot(session)
        take_windows(paths, images)
        take_pressure(paths, images)
        take_pressure_change(paths, images)
        take_feet(paths, session, images, VARIANT[language])
        take_foot_stage(paths, session, images)
        take_clinic(of_clinic, session, images, language)
    take_devices(images, language)


def images_of(language: str) -> Path:
    """Return the folder of the pictures of a language."""
    images = IMAGES if language == "en" else IMAGES / language
    images.mkdir(exist_ok=True)
    return images


def user(folder: Path, language: Language) -> UserPaths:
    """Return the files of a user who has chosen a language."""
    folder.mkdir()
    paths = UserPaths(folder / "settings.json", folder / "autosave")
    save_settings(Settings(language=language), paths.settings_file)
    return paths


def take_windows(paths: UserPaths, images: Path) -> None:
    """The window in both themes, a pelott in the hand."""
    for name, size, dark in (("light", SMALL, False), ("dark-height-map", LARGE, True)):
        with ScriptedWindow(paths, size, dark) as studio:
            act(studio, "open_example", "tool_pelott")
            studio.app.case.select("pelott")
            if dark:
                act(studio, "map_height")
            studio.screenshot(images / f"window-{name}.png")


def take_feet(paths: UserPaths, session: Path, images: Path, variant: str) -> None:
    """Both feet side by side, then two variants of one."""
    with ScriptedWindow(paths, SMALL) as studio:
        act(studio, "open_example")
        studio.open(session)
        features, case = studio.app.features, studio.app.case
        features.foot.close()
        features.design.feet.take(Side.RIGHT)
        features.design.feet.copy_prescription()
        for notice in studio.app.services.notices.notices:
            studio.app.services.notices.drop(notice.key)
        act(studio, "beside_foot", "map_difference")
        studio.screenshot(images / "feet-compared.png")

        act(studio, "variant_duplicate")
        studio.answers.typed = variant
        act(studio, "variant_name")
        design = case.record.design
        assert design is not None
        for correction in design.corrections:
            if isinstance(correction, Pelott):
                design = design.with_changed(replace(correction, height_mm=9.0))
            if isinstance(correction, Posting):
                design = design.with_changed(replace(correction, rearfoot_deg=2.0))
        case.apply(design, "Change the variant")
        act(studio, "beside_variant", "map_difference")
        studio.screenshot(images / "variants-compared.png")


def take_foot_stage(paths: UserPaths, session: Path, images: Path) -> None:
    """The views in their colours, their distance, and what is corrected by hand."""
    with ScriptedWindow(paths, SMALL) as studio:
        studio.open(session)
        take_stage(studio, images / "foot-views.png")
        stage_of(studio).presenter.choose_map(FootMap.AGREEMENT)
        take_stage(studio, images / "foot-agreement.png")
    write_edits(EDITS, session)
    with ScriptedWindow(paths, SMALL) as studio:
        studio.open(session)
        stage_of(studio).view.table.selectRow(0)
        take_stage(studio, images / "foot-corrected.png")


def take_clinic(paths: UserPaths, session: Path, images: Path, language: str) -> None:
    """The start page of a clinic, all dialogs, and a scan of another program."""
    fill_record(paths, language)
    with ScriptedWindow(paths, SMALL, emulate=session) as studio:
        open_record(studio)
        studio.screenshot(images / "start-page.png")
        act(studio, "open_example")
        take_dialogs(studio, images)
        scan = paths.settings_folder / "scan 17.ply"
        foot = studio.app.case.foot
        assert foot is not None
        write_ply(foot.mesh, scan)
        act(studio, "new_case")
        studio.app.features.case_files.opener.open_path(scan)
        take_and_close(SCAN, lambda shown: save(shown, images, SCAN.name))


def take_pressure(paths: UserPaths, images: Path) -> None:
    """A pressure map under the foot: its own heights as pressures of 6 mm cells, toes first."""
    with ScriptedWindow(paths, SMALL) as studio:
        act(studio, "open_example")
        foot = studio.app.case.foot
        assert foot is not None
        heights_mm = SolePrint.of(foot).heights_mm[::3, ::3]
        kpa = np.round(np.clip(7 - heights_mm, 0, None)[::-1] * 70, 1)
        plate = paths.settings_folder / "plate.csv"
        rows = "\n".join(";".join(str(value) for value in row) for row in kpa)
        plate.write_text(f"unit: kPa\npitch_mm: 6\n{rows}\n", "utf-8")
        studio.app.features.design.plantar.open(plate)
        studio.settle()
        (dialog,) = studio.app.window.findChildren(PressureDialog)
        for box, value in ((dialog.side, foot.side.value), (dialog.seen_from, "above")):
            box.setCurrentIndex(box.findData(value))
            box.activated.emit(box.currentIndex())
        dialog.lay_button.click()
        studio.settle()
        act(studio, "tool_plantar", "map_pressure")
        studio.screenshot(images / "pressure.png")


def take_pressure_change(paths: UserPaths, images: Path) -> None:
    """How load moves on the example, for a person of 75 kg."""
    with ScriptedWindow(paths, SMALL) as studio:
        act(studio, "open_example", "map_load")
        (dialog,) = studio.app.window.findChildren(LoadDialog)
        dialog.was_read.click()
        dialog.go_on.click()
        dialog.weight.setValue(75.0)
        studio.settle()
        window = studio.app.window
        dialog.resize(dialog.width(), window.height() - 2 * BORDER)
        dialog.move(window.mapToGlobal(QPoint(0, BORDER)))
        studio.settle()
        image = grab_window(studio.app)
        painter = QPainter(image)  # the figures are told in a window of their own
        painter.drawPixmap(0, BORDER, dialog.grab())
        painter.setPen(QPen(Qt.GlobalColor.darkGray, 2))
        painter.drawRect(0, BORDER, dialog.width(), dialog.height())
        painter.end()
        image.save(str(images / "pressure-change.png"))


def take_devices(images: Path, language: str) -> None:
    """Draw the devices of the product on the foot of the example."""
    foot = read_case(EXAMPLE).foot
    assert foot is not None
    draw_devices(foot, images / "devices.png", translation_into(language))


def take_stage(studio: ScriptedWindow, path: Path) -> None:
    """Take the foot stage."""
    stage = stage_of(studio)
    stage.resize(*STAGE)
    studio.settle()
    grab(stage, [stage.view.foot.scene]).save(str(path))


def stage_of(studio: ScriptedWindow) -> FootStage:
    """Give the foot stage that is open."""
    stage = studio.app.features.foot.stage
    assert stage is not None
    return stage


def act(studio: ScriptedWindow, *keys: str) -> None:
    """Run actions of the menus."""
    for key in keys:
        studio.app.window.actions_by_key[key].trigger()
        studio.settle()


if __name__ == "__main__":
    main()

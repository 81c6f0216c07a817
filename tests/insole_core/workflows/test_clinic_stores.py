"""What the clinic keeps beside the settings, where its folder cannot be made."""

from __future__ import annotations

from pathlib import Path

import pytest

from insole_core.errors import InputError, OutputError
from insole_core.solids.export_rules import read_rules
from insole_core.solids.shop import read_shop
from insole_core.workflows.clinic_tables import ClinicBlocks, ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import OrderChoice


@pytest.mark.parametrize("store", ["blocks", "rules", "order"])
def test_a_folder_that_cannot_be_made_is_one_sentence(tmp_path: Path, store: str) -> None:
    (tmp_path / "file").write_bytes(b"")
    path = tmp_path / "file" / f"{store}.json"
    save = {
        "blocks": lambda: ClinicBlocks(path).save(()),
        "rules": lambda: ClinicExportRules(path).save(read_rules()),
        "order": lambda: LastOrder(path, read_shop()).save(OrderChoice()),
    }[store]
    with pytest.raises(OutputError, match="cannot be written"):
        save()


@pytest.mark.parametrize(
    "store", [ClinicBlocks, ClinicExportRules], ids=["the blocks", "the export rules"]
)
def test_a_file_that_cannot_be_read_is_kept_when_another_is_stored(
    tmp_path: Path, store: type[ClinicBlocks] | type[ClinicExportRules]
):
    path = tmp_path / "clinic.json"
    path.write_text("half a fi")
    kept = store(path)
    with pytest.raises(InputError):
        kept.load()
    kept.save(() if isinstance(kept, ClinicBlocks) else read_rules())
    assert (tmp_path / "clinic.json.broken-1").read_text() == "half a fi"
    kept.load()

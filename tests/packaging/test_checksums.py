"""Checksums are signed; a clinic with only the public key sees whether a file is genuine."""

import shutil
import subprocess

import pytest

from bundle.checksums import sign, write_checksums

KEY = "Throw-away <throw-away@example.org>"


@pytest.fixture
def published(tmp_path):
    folder = tmp_path / "published"
    folder.mkdir()
    files = [folder / "insole-studio_1.2.0_amd64.deb", folder / "insole-studio-1.2.0.cdx.json"]
    for path in files:
        path.write_bytes(path.name.encode() * 1000)
    write_checksums(files, folder)
    return folder


def passes(call, folder):
    return subprocess.run(call, cwd=folder, capture_output=True, check=False).returncode == 0


def are_genuine(verify, folder):
    """Do what packaging/README.md tells."""
    sums = ["sha256sum", "--check", "--ignore-missing", "SHA256SUMS"]
    return passes(verify, folder) and passes(sums, folder)


def refuses_what_was_changed(verify, folder):
    package = folder / "insole-studio_1.2.0_amd64.deb"
    package.write_bytes(b"other" + package.read_bytes())
    refused_file = not are_genuine(verify, folder)
    write_checksums(folder.glob("insole-studio*"), folder)
    return refused_file and not are_genuine(verify, folder)


@pytest.mark.skipif(not shutil.which("gpg"), reason="GnuPG is not installed")
def test_with_gnupg(published, tmp_path, monkeypatch):
    homes = {name: tmp_path / name for name in ("maker", "clinic")}
    for home in homes.values():
        home.mkdir(mode=0o700)
    monkeypatch.setenv("GNUPGHOME", str(homes["maker"]))
    unlocked = ["gpg", "--batch", "--passphrase", ""]
    subprocess.run(
        [*unlocked, "--quick-gen-key", KEY, "ed25519", "sign"], capture_output=True, check=True
    )
    sign(published / "SHA256SUMS", KEY)
    public = subprocess.run(["gpg", "--export", KEY], capture_output=True, check=True).stdout
    verify = ["gpg", "--verify", "SHA256SUMS.asc", "SHA256SUMS"]

    monkeypatch.setenv("GNUPGHOME", str(homes["clinic"]))
    assert not are_genuine(verify, published)  # without the key nothing is known
    subprocess.run(["gpg", "--import"], input=public, capture_output=True, check=True)
    assert are_genuine(verify, published)
    assert refuses_what_was_changed(verify, published)
    for home in homes.values():
        subprocess.run(["gpgconf", "--homedir", str(home), "--kill", "all"], check=False)


@pytest.mark.skipif(not shutil.which("minisign"), reason="minisign is not installed")
def test_with_minisign(published, tmp_path):
    secret, public = tmp_path / "secret.key", tmp_path / "public.pub"
    make = ["minisign", "-G", "-W", "-s", str(secret), "-p", str(public)]
    subprocess.run(make, capture_output=True, check=True)
    sign(published / "SHA256SUMS", str(secret))
    verify = ["minisign", "-V", "-p", str(public), "-m", "SHA256SUMS"]
    assert are_genuine(verify, published)
    assert refuses_what_was_changed(verify, published)

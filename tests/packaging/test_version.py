import subprocess

import pytest

from bundle.version import from_description, version_of

PROJECT = '[project]\nname = "insole-studio"\nversion = "0.7.0"\n'


def git(folder, *arguments):
    identity = ["-c", "user.name=T", "-c", "user.email=t@example.org"]
    subprocess.run(["git", "-C", str(folder), *identity, *arguments], check=True)


@pytest.fixture
def checkout(tmp_path):
    (tmp_path / "pyproject.toml").write_text(PROJECT)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-q", "-m", "first")
    return tmp_path


def test_it_is_that_of_the_tag(checkout):
    git(checkout, "tag", "-a", "v1.2.0", "-m", "v1.2.0")
    assert version_of(checkout) == "1.2.0"


def test_commits_after_the_tag_are_counted(checkout):
    git(checkout, "tag", "-a", "v1.2.0", "-m", "v1.2.0")
    git(checkout, "commit", "-q", "--allow-empty", "-m", "second")
    assert version_of(checkout).startswith("1.2.0+1.g")


def test_without_a_tag_it_is_that_of_the_project(checkout):
    assert version_of(checkout).startswith("0.7.0+g")


def test_without_git_it_is_that_of_the_project(tmp_path):
    (tmp_path / "pyproject.toml").write_text(PROJECT)
    # below the folder of tests there may be a checkout: its tags are not this one's
    (tmp_path / ".git").write_text("gitdir: nowhere\n")
    assert version_of(tmp_path) == "0.7.0"


def test_a_tag_that_is_no_version_is_refused():
    with pytest.raises(ValueError, match="no version"):
        from_description("release-candidate-3-gabc")

"""Accounts: who signs in, who is locked out, and what each role may do."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from argon2 import PasswordHasher
from sqlalchemy import select
from stations import FIRST, add_member, proven

from insole_core.errors import FirstPassword, InputError, NotAllowed, RecordsError
from insole_core.messages import Message
from insole_core.records import passwords, schema
from insole_core.records.accounts import (
    FIRST_LOCK_S,
    FREE_FAILURES,
    LONGEST_LOCK_S,
    Account,
    Accounts,
)
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author, Proof, Role, system_user
from insole_core.records.database import Database
from insole_core.records.passwords import check_password, hash_password, is_password
from insole_core.records.rights import RIGHTS, Right, require

GOOD, BETTER = "vier Schuhe gehen", "långa korridorer ekar"
SYSTEM_USER = Author("operator", "desk")
CHEF = proven("chef", Role.ADMINISTRATOR)


@dataclass
class Clocks:
    """A clock that can be put forward and back, and one that cannot."""

    now: float = 1.8e9
    monotonic: float = 50.0

    def wait(self, seconds: float) -> None:
        self.now += seconds
        self.monotonic += seconds


@pytest.fixture
def clocks() -> Clocks:
    return Clocks()


def accounts_of(database: Database, clocks: Clocks, who: Author = SYSTEM_USER) -> Accounts:
    return Accounts(database, who, now=lambda: clocks.now, monotonic=lambda: clocks.monotonic)


@pytest.fixture
def administered(database: Database, clocks: Clocks) -> Accounts:
    """The accounts as the first administrator sees them."""
    accounts_of(database, clocks).switch_on("chef", "Carla Chef", GOOD)
    return accounts_of(database, clocks, CHEF)


@pytest.fixture
def anna(administered: Accounts) -> Account:
    return add_member(administered, "Anna", "Anna Åkesson", Role.ORTHOPEDIST, BETTER)


def actions(database: Database) -> list[str]:
    return [line.action for line in reversed(AuditLog(database, CHEF).lines())]


def refuse(accounts: Accounts, name: str, times: int) -> None:
    for _ in range(times):
        with pytest.raises(NotAllowed, match="name or the password is wrong"):
            accounts.sign_in(name, "wrong password")


def test_accounts_are_off_at_first_and_everybody_may_do_everything(database: Database) -> None:
    accounts = Accounts(database, SYSTEM_USER)
    assert not accounts.are_on
    assert accounts.all() == []
    with database.reading() as connection:
        for right in Right:
            require(connection, SYSTEM_USER, right)


def test_there_is_no_account_that_nobody_made(database: Database) -> None:
    accounts = Accounts(database, SYSTEM_USER)
    for name in ("admin", "administrator", "operator", ""):
        for password in ("", "admin", "password"):
            with pytest.raises(NotAllowed):
                accounts.sign_in(name, password)
    with pytest.raises(RecordsError, match="switched off"):
        accounts.add("anna", "Anna", Role.ORTHOPEDIST, GOOD)


def test_the_first_administrator_is_made_by_switching_on(administered: Accounts) -> None:
    assert administered.are_on
    (chef,) = administered.all()
    assert (chef.name, chef.role) == ("chef", Role.ADMINISTRATOR)
    author = administered.sign_in("chef", GOOD)
    assert author == CHEF
    with pytest.raises(RecordsError, match="on already"):
        administered.switch_on("eva", "Eva", GOOD)


def test_switching_off_and_on_again_takes_a_new_password(
    administered: Accounts, anna: Account
) -> None:
    with pytest.raises(NotAllowed):
        Accounts(administered._database, proven(anna.name)).switch_off()
    administered.switch_off()
    assert not administered.are_on
    administered.switch_on("chef", "Carla Chef", BETTER)
    assert [account.name for account in administered.all()] == ["anna", "chef"]
    refuse(administered, "chef", 1)
    assert administered.sign_in("chef", BETTER).name == "chef"


def test_only_argon2id_hashes_are_stored(database: Database, anna: Account) -> None:
    with database.reading() as connection:
        stored = connection.execute(select(schema.accounts.c.password_hash)).scalars().all()
    assert all(text.startswith("$argon2id$v=19$") for text in stored)
    assert len(set(stored)) == 2
    raw = Path(database.place.database_file).read_bytes()
    assert BETTER.encode() not in raw


def test_default_parameters_are_those_of_rfc_9106() -> None:
    hasher = PasswordHasher()
    assert (hasher.memory_cost, hasher.time_cost, hasher.parallelism) == (65536, 3, 4)
    assert hasher.type.name == "ID"


def test_names_are_signed_in_with_in_any_case_and_composition(
    administered: Accounts, anna: Account
) -> None:
    assert administered.sign_in("  ANNA ", BETTER).name == "anna"
    decomposed = "la\u030anga korridorer ekar"
    assert administered.sign_in("anna", decomposed).role is Role.ORTHOPEDIST


@pytest.mark.parametrize("name", ["", "a b", "'; DROP TABLE accounts; --", "x" * 61, "a\u202eb"])
def test_a_name_that_will_not_do_is_refused(administered: Accounts, name: str) -> None:
    with pytest.raises(InputError, match="letters, digits"):
        administered.add(name, "Eva Ek", Role.TECHNICIAN, BETTER)


@pytest.mark.parametrize("full_name", ["", "  ", "x" * 10_000, "Eva\u202eEk"])
def test_a_full_name_that_will_not_do_is_refused(administered: Accounts, full_name: str) -> None:
    with pytest.raises(InputError, match="full name"):
        administered.add("eva", full_name, Role.TECHNICIAN, BETTER)


def test_a_name_is_given_once(administered: Accounts, anna: Account) -> None:
    with pytest.raises(InputError, match="an account anna already"):
        administered.add("ANNA", "Another", Role.TECHNICIAN, BETTER)


@pytest.mark.parametrize(
    ("password", "reason"),
    [
        ("", "has 0 characters"),
        ("short one", "has 9 characters"),
        ("x" * 1001, "has 1001 characters"),
        ("aaaaaaaaaaaaaaaa", "repeats few characters"),
        ("abababababababab", "repeats few characters"),
        ("qwertyuiop123456", "first that are tried"),
        ("1234567890abcdefgh", "first that are tried"),
        ("insolestudio12345", "first that are tried"),
        ("anna-åkesson-1970", "first that are tried"),
    ],
)
def test_a_weak_password_is_refused_with_the_reason(password: str, reason: str) -> None:
    with pytest.raises(InputError, match=reason) as caught:
        check_password(password, "anna", "Anna Åkesson")
    assert not password or password not in str(caught.value)


def test_hashes_tell_passwords_apart() -> None:
    stored = hash_password(GOOD)
    assert is_password(GOOD, stored)
    assert not is_password(GOOD + " ", stored)
    assert not is_password(GOOD, "damaged")
    assert not is_password(GOOD, None)
    assert not is_password("nobody", None)


@pytest.mark.parametrize(("mine", "forged"), [("m=", "m=9999999"), ("t=", "t=99999999")])
def test_a_forged_hash_that_would_take_for_ever_is_refused_at_once(mine: str, forged: str) -> None:
    assert not is_password(GOOD, hash_password(GOOD).replace(mine, forged))


def test_an_outdated_hash_is_made_anew_when_its_owner_signs_in(
    database: Database, administered: Accounts, anna: Account, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(passwords, "_HASHER", PasswordHasher(2, 16, 1))
    administered.sign_in("anna", BETTER)
    with database.reading() as connection:
        query = select(schema.accounts.c.password_hash).where(schema.accounts.c.name == "anna")
        assert "m=16,t=2" in str(connection.execute(query).scalar())


def test_too_many_failures_lock_the_account_and_time_unlocks_it(
    administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    with pytest.raises(NotAllowed, match="wait 1 min"):
        administered.sign_in("anna", BETTER)
    clocks.wait(FIRST_LOCK_S + 1)
    assert administered.sign_in("anna", BETTER).name == "anna"
    refuse(administered, "anna", FREE_FAILURES - 1)  # the count began anew
    assert administered.sign_in("anna", BETTER).name == "anna"


def test_each_failure_after_a_lock_doubles_it(
    administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    clocks.wait(FIRST_LOCK_S + 1)
    refuse(administered, "anna", 1)
    with pytest.raises(NotAllowed, match="wait 2 min"):
        administered.sign_in("anna", BETTER)
    for _ in range(9):
        clocks.wait(LONGEST_LOCK_S + 1)
        refuse(administered, "anna", 1)
    with pytest.raises(NotAllowed, match="wait 60 min"):
        administered.sign_in("anna", BETTER)


def test_a_clock_put_forward_does_not_end_a_lock(
    administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    clocks.now += 86_400
    with pytest.raises(NotAllowed, match="wait 1 min"):
        administered.sign_in("anna", BETTER)


def test_after_a_new_start_a_clock_put_forward_gives_one_attempt(
    database: Database, administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    clocks.now += 86_400
    started_anew = accounts_of(database, clocks)
    refuse(started_anew, "anna", 1)
    with pytest.raises(NotAllowed, match="wait 2 min"):
        started_anew.sign_in("anna", BETTER)


def test_a_clock_put_back_does_not_lock_for_good(
    database: Database, administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    clocks.now -= 10 * 365 * 86_400
    started_anew = accounts_of(database, clocks)
    with pytest.raises(NotAllowed, match="wait 1 min"):
        started_anew.sign_in("anna", BETTER)
    clocks.wait(FIRST_LOCK_S + 1)
    assert started_anew.sign_in("anna", BETTER).name == "anna"


def test_a_lock_holds_at_every_station(
    database: Database, administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    with pytest.raises(NotAllowed, match="wait 1 min"):
        accounts_of(database, clocks, Author("?", "capture room")).sign_in("anna", BETTER)


def test_an_attempt_is_counted_before_its_password_is_checked(
    administered: Accounts, anna: Account, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program that is killed while it checks leaves the failure counted."""

    def killed(*_arguments: object) -> bool:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("insole_core.records.accounts.is_password", killed)
        for _ in range(FREE_FAILURES):
            with pytest.raises(KeyboardInterrupt):
                administered.sign_in("anna", BETTER)
    with pytest.raises(NotAllowed, match="wait 1 min"):
        administered.sign_in("anna", BETTER)


def test_an_administrator_unlocks(administered: Accounts, anna: Account) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    administered.unlock(anna.id)
    assert administered.sign_in("anna", BETTER).name == "anna"


@pytest.fixture
def read_only(database: Database, anna: Account) -> Iterator[Database]:
    """The database of Anna's account, opened so that nothing of it changes."""
    opened = Database(database.place, problem=Message("It may only be read."))
    yield opened
    opened.close()


def test_accounts_sign_in_where_the_record_may_only_be_read(
    read_only: Database, database: Database, clocks: Clocks
) -> None:
    before = actions(database)
    accounts = accounts_of(read_only, clocks)
    refuse(accounts, "nobody", 1)
    refuse(accounts, "anna", FREE_FAILURES)
    with pytest.raises(NotAllowed, match="wait 1 min"):
        accounts.sign_in("anna", BETTER)
    clocks.now += 86_400  # which the other clock does not believe
    with pytest.raises(NotAllowed, match="wait 1 min"):
        accounts.sign_in("anna", BETTER)
    clocks.wait(FIRST_LOCK_S + 1)
    refuse(accounts, "anna", 1)
    with pytest.raises(NotAllowed, match="wait 2 min"):
        accounts.sign_in("anna", BETTER)
    clocks.wait(2 * FIRST_LOCK_S + 1)
    assert accounts.sign_in("anna", BETTER) == proven("anna")
    refuse(accounts, "anna", FREE_FAILURES - 1)  # the count began anew
    assert accounts.sign_in("chef", GOOD).role is Role.ADMINISTRATOR
    assert actions(database) == before


def test_a_lock_of_the_record_holds_where_it_may_only_be_read(
    read_only: Database, administered: Accounts, clocks: Clocks
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    accounts = accounts_of(read_only, clocks)
    with pytest.raises(NotAllowed, match="wait 1 min"):
        accounts.sign_in("anna", BETTER)
    clocks.wait(FIRST_LOCK_S + 1)
    assert accounts.sign_in("anna", BETTER).name == "anna"


def test_somebody_disabled_signs_in_nowhere(
    read_only: Database, administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    administered.change(replace(anna, is_disabled=True))
    with pytest.raises(NotAllowed, match="name or the password is wrong"):
        accounts_of(read_only, clocks).sign_in("anna", BETTER)


def test_passwords_are_changed_by_their_owner(administered: Accounts, anna: Account) -> None:
    new = "ekar i kala rum"
    with pytest.raises(NotAllowed):
        administered.change_password("anna", "wrong password", new)
    with pytest.raises(InputError, match="had before"):
        administered.change_password("anna", BETTER, BETTER)
    with pytest.raises(InputError, match="characters"):
        administered.change_password("anna", BETTER, "short")
    administered.change_password("anna", BETTER, new)
    refuse(administered, "anna", 1)
    assert administered.sign_in("anna", new).name == "anna"


def test_a_first_password_lets_nobody_in_until_its_owner_has_chosen_another_one(
    database: Database, administered: Accounts
) -> None:
    eva = administered.add("eva", "Eva Ek", Role.TECHNICIAN, FIRST)
    assert eva.has_first_password
    for _ in range(FREE_FAILURES + 1):  # it is right, so it locks nobody out
        with pytest.raises(FirstPassword, match="eva was chosen by somebody else"):
            administered.sign_in("eva", FIRST)
    with pytest.raises(InputError, match="had before"):
        administered.change_password("eva", FIRST, FIRST)
    assert "signed in" not in actions(database)
    assert administered.change_password("eva", FIRST, BETTER) == proven("eva", Role.TECHNICIAN)
    assert administered.sign_in("eva", BETTER).name == "eva"
    assert not administered.all()[1].has_first_password


def test_a_scheduled_task_keeps_the_password_it_was_given(administered: Accounts) -> None:
    night = administered.add("night", "Backups", Role.BACKUP_SERVICE, FIRST)
    assert administered.sign_in("night", FIRST).role is Role.BACKUP_SERVICE
    administered.reset_password(night.id, GOOD)
    assert administered.sign_in("night", GOOD).role is Role.BACKUP_SERVICE


def test_an_account_of_a_user_of_the_system_needs_no_password(
    database: Database, administered: Accounts, anna: Account, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LOGNAME", "somebody")
    assert administered.sign_in_system_user() is None
    administered.change(replace(anna, system_user=system_user()))
    author = administered.sign_in_system_user()
    assert author == replace(proven("anna"), proof=Proof.SYSTEM_USER)
    with database.reading() as connection:
        require(connection, author, Right.SEE)
    assert '"signed_in_by":"system user"' in AuditLog(database, CHEF).lines()[0].details
    (chef,) = (account for account in administered.all() if account.name == "chef")
    with pytest.raises(InputError, match="has the account anna already"):
        administered.change(replace(chef, system_user=system_user()))
    administered.change(replace(anna, system_user=system_user(), is_disabled=True))
    assert administered.sign_in_system_user() is None


def test_passwords_are_reset_by_an_administrator(
    database: Database, administered: Accounts, anna: Account, clocks: Clocks
) -> None:
    with pytest.raises(NotAllowed, match="may not manage accounts"):
        accounts_of(database, clocks, proven("anna")).reset_password(anna.id, GOOD)
    administered.reset_password(anna.id, GOOD)
    with pytest.raises(FirstPassword):
        administered.sign_in("anna", GOOD)
    with pytest.raises(RecordsError, match="no such account"):
        administered.reset_password("?", GOOD)


def test_a_disabled_account_cannot_sign_in_or_go_on(
    database: Database, administered: Accounts, anna: Account
) -> None:
    signed_in = administered.sign_in("anna", BETTER)
    administered.change(replace(anna, is_disabled=True))
    refuse(administered, "anna", 1)
    with pytest.raises(NotAllowed, match="not signed in"), database.reading() as connection:
        require(connection, signed_in, Right.SEE)


def test_the_last_administrator_stays(administered: Accounts) -> None:
    (chef,) = administered.all()
    for changed in (replace(chef, is_disabled=True), replace(chef, role=Role.ORTHOPEDIST)):
        with pytest.raises(RecordsError, match="only administrator"):
            administered.change(changed)
    assert administered.all() == [chef]


MATRIX = {
    Right.SEE: "ot",
    Right.WRITE: "ot",
    Right.CAPTURE: "ot",
    Right.ORDER: "ot",
    Right.EXPORT: "o",
    Right.SIGN: "o",
    Right.MERGE: "o",
    Right.ERASE: "a",
    Right.READ_AUDIT: "a",
    Right.BACK_UP: "otab",
    Right.SET_UP: "a",
    Right.MANAGE_ACCOUNTS: "a",
}


@pytest.mark.parametrize("role", Role)
def test_roles_have_their_rights(database: Database, administered: Accounts, role: Role) -> None:
    assert set(MATRIX) == set(Right)
    administered.add("eva", "Eva Ek", role, BETTER)
    eva = proven("eva", Role.ADMINISTRATOR)  # what the window believes does not count
    with database.reading() as connection:
        for right, allowed in MATRIX.items():
            if role[0] in allowed:
                require(connection, eva, right)
            else:
                with pytest.raises(NotAllowed, match=f"eva .{role}. may not {right}"):
                    require(connection, eva, right)


def test_every_right_is_somebodys() -> None:
    assert frozenset().union(*RIGHTS.values()) == set(Right)


def test_the_audit_log_tells_what_happened_and_no_password(
    database: Database, administered: Accounts, anna: Account
) -> None:
    refuse(administered, "anna", FREE_FAILURES)
    with pytest.raises(NotAllowed):
        administered.sign_in("anna", BETTER)
    refuse(administered, BETTER, 1)  # the password in the field of the name
    administered.unlock(anna.id)
    administered.change_password("anna", BETTER, GOOD)
    assert actions(database) == [
        "switched on", "added", "signed in", "changed password",
        "locked", "refused", "refused", "unlocked", "signed in", "changed password",
    ]  # fmt: skip
    lines = AuditLog(database, CHEF).lines()
    assert not any(text in str(vars(line)) for line in lines for text in (GOOD, BETTER))
    assert AuditLog(database, CHEF).verify().is_intact

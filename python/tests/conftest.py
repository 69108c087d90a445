"""Where things are."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def root():
    """The project's folder."""
    return ROOT


@pytest.fixture(scope="session")
def mission(root):
    """A recorded mission that conforms."""
    return root / "tests/logs/mission.log"


@pytest.fixture(scope="session")
def finished(root):
    """A recorded run in which FINISHED was declared at speed."""
    return root / "tests/logs/finished-while-moving.log"


@pytest.fixture
def command():
    """The command adsdv, where ADSDV names a built one."""
    return os.environ.get("ADSDV") or pytest.skip("ADSDV names no adsdv")


def pytest_generate_tests(metafunc):
    """Every recorded log."""
    if "any_log" in metafunc.fixturenames:
        logs = sorted((ROOT / "tests/logs").glob("*.log"))
        assert logs
        metafunc.parametrize("any_log", logs, ids=lambda log: log.stem)

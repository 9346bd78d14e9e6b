"""Logs as arrays."""
import numpy as np
import pytest

import cairn
from conftest import SOURCE

LOG = SOURCE / "tests/data/carmen.log"


def flaser_lines():
    return [line.split() for line in LOG.read_text().splitlines() if line.startswith("FLASER")]


def test_ranges_are_those_of_the_file():
    log = cairn.read_log(LOG, "carmen_log")
    lines = flaser_lines()
    scans = [at for at in range(len(log)) if log.ranges(at).stop - log.ranges(at).start == 5]  # sonars are 16
    assert len(scans) == len(lines)
    for at, words in zip(scans, lines):
        ranges = log.range_m[log.ranges(at)]
        written = np.array(words[2:7], dtype=float)
        heard = np.isfinite(ranges)
        assert heard.sum() >= 4
        np.testing.assert_array_equal(ranges[heard], written[heard])
    assert log.first_range[0] == 0 and log.first_range[-1] == len(log.range_m)
    assert log.sensor_pose.shape == (len(log.range_m), 3)
    assert np.all(np.diff(log.stamp_s) >= 0)


def test_a_log_that_is_missing_or_none_says_so(tmp_path):
    with pytest.raises(cairn.FileError, match="none.log"):
        cairn.read_log(tmp_path / "none.log", "carmen_log")
    with pytest.raises(cairn.FileError, match="carmen_log"):
        cairn.read_log(LOG, "carmen_lok")

"""The time that a simulated second of the filter of 15 states takes: filterpy's, and beside it ours.

    cargo bench -p albacore-navigation --bench ukf | python docs/navigation/beside_filterpy.py
    python docs/navigation/beside_filterpy.py 0.21

Wants filterpy 2.0.0 and numpy. Both filters have the same instruments at the same rates; filterpy's runs over the series `ins15_a` of
runtime/navigation/tests/ukf, and is held to it. The number is ours, in ms, as the benchmark prints it.
"""

import csv
import json
import math
import re
import sys
import time
from pathlib import Path

import filterpy
import numpy as np
from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter

SERIES = Path(__file__).resolve().parents[2] / "runtime/navigation/tests/ukf"
TRIES = 5


def rows(name):
    with open(SERIES / name, newline="", encoding="utf-8") as table:
        lines = csv.reader(table)
        next(lines)
        return list(lines)


PARAMS = json.loads((SERIES / "ins15_a_params.json").read_text(encoding="utf-8"))
DT = PARAMS["dt"]
IMU = [[float(cell) for cell in row[1:7]] for row in rows("ins15_a_imu.csv")]
EXPECTED = {int(row[0]): np.array(row[2:32], float) for row in rows("ins15_a_expected.csv")}
MEASURED = {}
for step, kind, *values in rows("ins15_a_meas.csv"):
    MEASURED.setdefault(int(step), []).append((kind, np.array([float(value) for value in values if value])))


def rotation(x):
    """Of the body's frame into north-east-down, row by row."""
    sr, cr, sp, cp, sy, cy = (turn(x[i]) for i in range(3) for turn in (math.sin, math.cos))
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def times(matrix, x, y, z):
    return [a * x + b * y + c * z for a, b, c in matrix]


def rates(x):
    """From rates of turn to those of roll, pitch and yaw."""
    sr, cr, tp, cp = math.sin(x[0]), math.cos(x[0]), math.tan(x[1]), math.cos(x[1])
    return (1, sr * tp, cr * tp), (0, cr, -sr), (0, sr / cp, cr / cp)


def process(x, dt, imu):
    """Eq. 14, on single numbers."""
    s = x.tolist()
    p, q, r = imu[0] - s[3], imu[1] - s[4], imu[2] - s[5]
    u, v, w = s[9:12]
    turned = rotation(s)
    # Gravity, as accelerometers feel it at rest, in the body's frame.
    gx, gy, gz = (PARAMS["gvec_eq4"][2] * column for column in turned[2])
    ax, ay, az = imu[3] - s[12] - gx, imu[4] - s[13] - gy, imu[5] - s[14] - gz
    attitude = times(rates(s), p, q, r)
    position = times(turned, u, v, w)
    velocity = (ax - (q * w - r * v), ay - (r * u - p * w), az - (p * v - q * u))
    for at, change in zip((0, 1, 2, 6, 7, 8, 9, 10, 11), (*attitude, *position, *velocity)):
        s[at] += dt * change
    return np.array(s)


def process_of_vectors(x, dt, imu):
    """The same in numpy, on vectors of three."""
    turned, imu, after = np.array(rotation(x)), np.array(imu), x.copy()
    turn, velocity = imu[:3] - x[3:6], x[9:12]
    after[:3] += dt * (np.array(rates(x)) @ turn)
    after[6:9] += dt * (turned @ velocity)
    after[9:12] += dt * (imu[3:] - np.cross(turn, velocity) - turned.T @ np.array(PARAMS["gvec_eq4"]) - x[12:])
    return after


def noise(x):
    """Eq. 16."""
    q = np.zeros((15, 15))
    turn = np.array(rates(x)) * (PARAMS["sigma_g"] * DT)
    q[:3, :3] = turn @ turn.T
    q[range(6, 9), range(6, 9)] = (PARAMS["sigma_u"] * DT) ** 2
    q[range(9, 12), range(9, 12)] = (PARAMS["sigma_a"] * DT) ** 2
    return q


def pressure(x):
    s = x.tolist()
    return np.array([PARAMS["rho"] * PARAMS["g"] * (s[8] + times(rotation(s), *PARAMS["l_pr"])[2])])


def ranges(x):
    s = x.tolist()
    turned = rotation(s)
    away = [s[6 + i] - PARAMS["transponder"][i] for i in range(3)]
    return np.array([math.dist(times(turned, *at), [-a for a in away]) for at in PARAMS["l_r"]])


def wrapped(a, b):
    difference = a - b
    difference[..., 2] = (difference[..., 2] + math.pi) % (2 * math.pi) - math.pi
    return difference


HOW = {
    "attitude": (lambda x: x[:3], np.diag(PARAMS["R_attitude_diag"]), wrapped),
    "pressure": (pressure, np.array([[PARAMS["R_pressure"]]]), np.subtract),
    "dvl": (lambda x: x[9:12], PARAMS["R_dvl"] * np.eye(3), np.subtract),
    "range": (ranges, PARAMS["R_range"] * np.eye(5), np.subtract),
}


def run(process):
    """The time of the series, s of the processor, and the greatest deviations of a state and of a variance."""
    points = MerweScaledSigmaPoints(15, PARAMS["alpha"], PARAMS["beta"], PARAMS["kappa"])
    kalman = UnscentedKalmanFilter(15, 3, DT, None, process, points)
    kalman.x, kalman.P = np.array(PARAMS["x0"]), np.diag(PARAMS["P0_diag"])
    worst, spent = [0.0, 0.0], 0.0
    for step, imu in enumerate(IMU, 1):
        begun = time.process_time()
        kalman.Q = noise(kalman.x.tolist())
        kalman.predict(imu=imu)
        for at, (kind, value) in enumerate(MEASURED.get(step, [])):
            expected, variance, kalman.residual_z = HOW[kind]
            if at > 0:
                # Of several measurements each has points of its own.
                kalman.sigmas_f = points.sigma_points(kalman.x, kalman.P)
            kalman.update(value, R=variance, hx=expected)
        spent += time.process_time() - begun
        if step in EXPECTED:
            expected = EXPECTED[step]
            off = (np.abs(kalman.x - expected[:15]).max(), np.abs(np.diag(kalman.P) - expected[15:]).max())
            worst = [max(a, float(b)) for a, b in zip(worst, off)]
    return spent, worst


def main():
    told = sys.argv[1] if len(sys.argv) > 1 else re.search(r"a second with all of it: ([\d.]+) ms", sys.stdin.read())[1]
    ours = float(told)
    print(f"filterpy {filterpy.__version__}, numpy {np.__version__}, Python {sys.version.split()[0]}")
    for kind, how in (("single numbers", process), ("vectors", process_of_vectors)):
        tries = [run(how) for _ in range(TRIES)]
        theirs = sorted(1000 * spent / (len(IMU) * DT) for spent, _ in tries)[TRIES // 2]
        states, variances = tries[0][1]
        print(f"a process on {kind}: off the series by {states:.1e} (states), {variances:.1e} (variances)")
        print(f"a simulated second: filterpy {theirs:.0f} ms, ours {ours:.3f} ms, a ratio of {theirs / ours:.0f}")


main()

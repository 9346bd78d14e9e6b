"""A board with a robot in an empty room of 4 x 3 m, to try a module without one: python3 board.py /tmp/board"""
import math, os, pty, select, sys, time, tty

SONARS_DEG = [90, 30, 15, 0, -15, -30, -90]  # as in robot.yaml, here all in the robot's middle

board, line = pty.openpty()
tty.setraw(line)
os.set_blocking(board, False)  # what nobody reads is left out
if os.path.lexists(sys.argv[1]):
    os.remove(sys.argv[1])
os.symlink(os.ttyname(line), sys.argv[1])

x, y, heading = 1.0, 1.5, 0.0  # in the room; the odometry begins there, too
v = w = heard_s = said_s = 0.0
text, sonar = "", 0


def say(words):
    try:
        os.write(board, words)
    except BlockingIOError:
        pass


def range_m(angle):
    """To the nearest wall."""
    across = [(wall - at) / step for at, step, size in ((x, math.cos(angle), 4.0), (y, math.sin(angle), 3.0))
              for wall in (0.0, size) if abs(step) > 1e-9]
    return min(distance for distance in across if distance > 0.0)


while True:
    time.sleep(0.02)
    now_s = time.monotonic()
    if select.select([board], [], [], 0)[0]:
        text += os.read(board, 1000).decode()
        *lines, text = text.split("\n")
        for words in (one.split() for one in lines):
            if words and words[0] == "go":
                v, w, heard_s = int(words[1]) / 1000, int(words[2]) / 1000, now_s
    if now_s - heard_s > 0.5:  # the board's own time-out, which nothing replaces
        v = w = 0.0
    heading += 0.02 * w
    x = min(max(x + 0.02 * v * math.cos(heading), 0.2), 3.8)
    y = min(max(y + 0.02 * v * math.sin(heading), 0.2), 2.8)
    say(b"sonar %d %d\n" % (sonar, 1000 * range_m(heading + math.radians(SONARS_DEG[sonar]))))
    sonar = (sonar + 1) % len(SONARS_DEG)
    if now_s - said_s > 0.05:
        said_s = now_s
        say(b"at %d %d %d\n" % (1000 * x, 1000 * y, 1000 * heading))

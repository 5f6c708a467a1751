"""What docs/growth.md measures: for each case its sizes, and of one size the files that it needs and the command.

A case is a function of a folder and a size. It writes its files there and gives the arguments of the command whose cost is measured;
`prepare` holds commands that are run before it and not measured.
"""

CASES = {}


def case(group, sizes, runs=3, prepare=None):
    """Names a case by its function."""

    def named(make):
        CASES[make.__name__] = (group, make.__doc__.strip(), sizes, runs, make, prepare)
        return make

    return named


def write(folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")
    return name


def mission(body, scenario="calm", within="100 h", inputs="", side=(1094, 367), top="", name="grow", with_="depth 2 m, speed 2 m/s"):
    return f"""mission {name} in {scenario} within {within} {{
    area op = rectangle(center: 36°10.804'N 75°44.458'W, along: 320 deg, length: {side[0]} m, width: {side[1]} m)
    limits {{ speed <= 2.6 m/s }}
    requires {{ position, course, heading{inputs} fresh 5 s, else abort }}
    recovery within 1 min {{ hold }}
    with {with_}
{top}
{body}
}}
"""


def run(*more):
    return ["run", "grow.alb", "--no-out", *more]

"""Print the lower bound of every dependency as the version to install: constraints for pip."""

import re
import tomllib
from pathlib import Path

project = tomllib.loads(Path("pyproject.toml").read_text("utf-8"))["project"]
extras = project["optional-dependencies"]
lists = [project["dependencies"], *(lines for name, lines in extras.items() if name != "dev")]
wanted = [line for lines in lists for line in lines]
pinned = {line.replace(">=", "==").partition(",")[0] for line in wanted if "raycert[" not in line}
if unbound := [line for line in pinned if not re.fullmatch(r"[\w-]+==[\w.]+", line)]:
    raise SystemExit(f"without a lower bound: {', '.join(sorted(unbound))}")
print(*sorted(pinned), sep="\n")

"""Parts and assemblies of CadQuery next to the kernel's checker, Green's theorem and the machine's own poses.

CadQuery and build123d stand on different versions of one kernel, so they cannot share an environment. `scripts/test`
makes one for CadQuery, 1.4 GB, and `tests/python/test_cadquery.py` runs this on a few designs:

    PYTHONPATH=python .venv-cadquery/bin/python tests/campaigns/cadquery_parts.py           # all designs
    PYTHONPATH=python .venv-cadquery/bin/python tests/campaigns/cadquery_parts.py press     # those named
"""

import argparse
import doctest
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]


def near(found, wanted, bound, what):
    """Raises where two figures differ by more than a bound."""
    if not abs(found - wanted) <= bound:
        raise SystemExit(f"{what}: {found!r}, not {wanted!r}")
    return abs(found - wanted)


def check(names):
    """Looks at every part and every assembly of the shipped designs named; of all if none is."""
    import cadquery as cq
    import centrode as ct
    import numpy as np
    from OCP.BRepCheck import BRepCheck_Analyzer

    parts, worst, off = 0, 0.0, 0.0
    folder = ROOT / "tests" / "designs"
    for path in [folder / f"{name}.toml" for name in names] or sorted(folder.glob("*.toml")):
        machine = ct.load(path)
        for name, solid in machine.solids().items():
            made = ct.cadquery.part(machine, name).val()
            if not (isinstance(made, cq.Solid) and BRepCheck_Analyzer(made.wrapped).IsValid()):
                raise SystemExit(f"{path.stem}: {name} is no valid solid")
            what = f"{path.stem}: volume of {name}"
            worst = max(worst, near(made.Volume(), solid.volume, 1e-9 * solid.volume, what) / solid.volume)
            parts += 1
        assembly = ct.cadquery.assembly(machine, phi=0.5)
        for phi in (0.5, 0.0, -2.0, 9.25):
            ct.cadquery.pose(assembly, machine, phi)
            frames = machine.frames(phi)
            for child in assembly.children:
                name, frame = child.name, frames[child.name]
                place = child.loc.wrapped.Transformation()
                rows = np.array([[place.Value(row, column) for column in (1, 2, 3, 4)] for row in (1, 2, 3)])
                off = max(
                    off, near(np.abs(rows - frame[:3]).max(), 0.0, 1e-9, f"{path.stem}: place of {name} at {phi}")
                )
        bodies = [link for link in machine.links() if link.mesh is not None or link.solids or link.part or link.mounted]
        if [child.name for child in assembly.children] != [link.name for link in bodies]:
            raise SystemExit(f"{path.stem}: the assembly has other links than the machine")
        wanted = sum(solid.volume for link in bodies for solid in link.solids)
        wanted += sum(volume(body) for link in bodies for body in link.mounted)
        if all(link.solids for link in bodies):
            near(assembly.toCompound().Volume(), wanted, 1e-9 * wanted, f"{path.stem}: volume of the assembly")
        print(f"{path.stem}: {len(machine.solids())} parts, {len(assembly.children)} links", flush=True)
        if isinstance(machine, ct.BoxDrive):
            shaft = ct.cadquery.part(machine, "shaft").val()
            if not BRepCheck_Analyzer(shaft.wrapped).IsValid():
                raise SystemExit(f"{path.stem}: the shaft is not valid")
            parts += 1
    print(
        f"{parts} parts valid, volumes within {worst:.1e} of Green's theorem, links within {off:.1e} mm of their laws"
    )


def volume(body):
    """Volume of a shaft, pin, ring or key, mm3, by Green's theorem, or of its STEP file as CadQuery reads it."""
    import cadquery as cq

    if body.step is None:
        return sum(solid.volume for solid in body.solids)
    with tempfile.NamedTemporaryFile(suffix=".step") as file:
        file.write(body.step)
        file.flush()
        return cq.importers.importStep(file.name).val().Volume()


def documented():
    """Runs the examples of the page of adapters."""
    page = (ROOT / "docs" / "adapters.md").read_text()
    (section,) = (one for one in page.split("\n## ") if one.startswith("CadQuery"))
    examples = doctest.DocTestParser().get_doctest(section.replace("```", "\n"), {}, "CadQuery", None, None)
    result = doctest.DocTestRunner(verbose=False).run(examples)
    if result.failed or not result.attempted:
        raise SystemExit(f"docs/adapters.md: {result}")
    print(f"docs/adapters.md: {result.attempted} examples")


def main():
    """Reads the arguments."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", help="shipped designs, without .toml; all if none is named")
    documented()
    check(parser.parse_args().names)


if __name__ == "__main__":
    main()

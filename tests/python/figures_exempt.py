"""Numbers of pages that no test in Python computes: patterns of the words around them, by the reason."""

INPUT = "given: an input, a size, a number of the example"
FORMULA = "part of a formula"
LIMIT = "a constant of the program, or a bound that its own tests keep"
RUST = "held by a test in Rust, in tests/published"
PEERS = "time, measured by benches/peers/run"
TIME = "time, measured by the bench or command named next to it"
PROOF = "the checker's count and time, minutes each: tools/proof_checker.py"
CAMPAIGN = "counted by the campaign named next to it"
SIMULATED = "measured by the play script named next to it, in the simulator"

EVERYWHERE = {
    "number of a heading or an item": (r"^#* ?\d+\. ",),
    "number of a step": (r"\[?\b[Ss]teps? \d(?:, \d and \d)?",),
    "year": (r"\b(?:of|in|The|al\.|Deb) (?:2018|2021|2022|2000)\b", r"as published in 2021"),
    "volume, pages, year": (r"^Sources?:.*\n(?:.+\n?)*", r"Int J Agric.*\n.*DOI", r"2nd edition.*", r"^  Press, 2009."),
    "number of an equation of the paper": (r"\(1?\d\)(?: to \(1?\d\)| and \(1?\d\))*", r"\((?:1\d)\), N"),
    "number of a figure of the paper": (r"Figures? \d(?:, \d and \d+)?",),
    "standard or version": (
        r"\bISO \d+(?:-\d)?",
        r"DIN \d+(?:-\d)?",
        r"(?:Python|CadQuery|build123d|FreeCAD|MuJoCo) \d+(?:\.\d+)?\b",
    ),
    "status or version": (r"\bstatus (?:at |is )?\d", r"makes it 1\.", r"3\.11 or newer"),
    "default of --tolerance": (r"(?:tolerance of |tolerance |default of |`--tolerance`, |in mm\. )0\.001",),
    "given by the paper": (r"m = 2\.25 mm, z = 23",),
}
EXEMPT = {
    "README.md": {
        INPUT: (r"with 0\.05 mm of it", r"5-axis"),
        TIME: (r"^\| (?:generate; prove|whole command|next to ncgears).*",),
    },
    "docs/adapters.md": {
        LIMIT: (r"1e-6 mm, are closed up: a kernel takes points 1e-7 mm",),
        "largest seen by the test or campaign of its row": (
            r"of 17 designs",
            r"^\| (?:volume of|links of|joints in).*",
        ),
        TIME: (r"the 2018 pair", r"\| 25 ms of processor time, 9 ms"),
    },
    "docs/design-page.md": {
        LIMIT: (
            r"slower than 20 ms",
            r"may have 4 MB",
            r"than 10 s",
            r"smaller than 2 MB",
            r"30,000 characters",
            r"narrower than 1060 pixels",
            r"1,048,576 bytes",
            r"no finer than 1e-7",
            r"no more than 20,000 inputs",
        ),
        INPUT: (r"Firefox \(153 ESR",),
        "time, measured by benches/browser/edits.py": (r"^\| `[\w-]+`.* \| \d+ \| \d+ \| \d+ \|",),
        "memory, measured by benches/browser/edits.py": (r"Over 2,000 edits .* a caret blinks",),
    },
    "docs/drive.md": {
        INPUT: (r"\(or -1\)", r"\(180 degrees\)"),
        LIMIT: (r"within 1e-7 of its stroke", r"120 at most"),
    },
    "docs/feeder.md": {
        INPUT: (
            r"angle of 40 degrees",
            r"before 40 degrees",
            r"tolerance of 0\.05 mm",
            r"with 30 teeth for 30",
            r"drives: 30 of 40",
            r"motor of 30 r/min and a chain of 2\.7",
            r"to 4/3",
            r"Of 30 driven",
            r"backlash of 0\.1 mm",
        ),
        FORMULA: (r"2 T / \(d t l\)",),
        LIMIT: (r"2000 random six-bars", r"more than 240 inputs", r"within 2 % of the contact"),
        SIMULATED: (r"effector is off the closed form by[^(]*\([^)]*\)",),
        PEERS: (r"^\| .*(?:ns|evaluations|ms) \|.*",),
    },
    "docs/files.md": {
        "status": (r"0 good, 1 a finding is an error, 2 no machine",),
        "release of the format": (r"release 2010",),
        "edition of the standard": (r"ISO 1328-1:2013",),
        LIMIT: (r"part is 100 mm long", r"less than 0\.05 mm of play"),
    },
    "docs/findings.md": {
        "status": (r"\| 0 \| 1 \| 2 \|", r"^Status 101 "),
        LIMIT: (r"below 0\.005 mm", r"above 50 deg", r"from 90 deg", r"below 30 deg", r"more than 1,000 times"),
    },
    "docs/how-to/shop.md": {
        INPUT: (r"release 12", r"than 0\.01", r"of 1/"),
        FORMULA: (r"a - j / \(2 sin .\)", r"E cos . / 2", r"j - 2 E", r"j / \(2 cos .\)"),
        LIMIT: (r"contact ratio of 1\.1",),
        RUST: (r"18 \+ the accuracy class: 26h for class 8",),
    },
    "docs/how-to/simulation.md": {
        "a size of PyBullet": (r"margin of 1 mm",),
    },
    "docs/how-to/teaching.md": {
        INPUT: (r"r = 30 .* mm", r"sin 2&phi;", r"of 3 to 1", r"Answers to 2 and 4"),
    },
    "docs/limits.md": {
        LIMIT: (r"and 48 where", r"from 1e-7 mm", r"up to 400 bodies", r"up to 1000 attributes"),
    },
    "docs/machine-file.md": {
        RUST: (r"to 1e-9\.",),
        INPUT: (
            r"at 30 degrees, at 5 mm",
            r"1 turns on through 360 degrees, 0 swings",
            r"-1 turns clockwise",
            r"may be 0 or negative",
            r"each 0 by default",
        ),
        FORMULA: (
            r"from 0 to 1 over an input from 0 to 1",
            r"0 to 180 deg",
            r"from 0 to 90 deg",
            r"above 90 deg",
            r"short of\s180 deg",
        ),
        LIMIT: (
            r"at least 6 values",
            r"angle of 2e-4 deg",
            r"below 30 deg",
            r"from layer 0 on, the frame in layer -1",
            r"a number below -1",
            r"is a plate in layer -1",
            r"\(ISO 4762\)",
            r"\(default 5\), `gap` \(1\), `width` \(8\)",
            r"`pin_diameter` \(3\)",
            r"closer than 8 mm",
            r"\(ISO 497 R''20\)",
            r"counts divided by 2\.2",
            r"\(1\.2 times `width`\), H9 on e9",
            r"whose shortest distance is 2 mm has plates of 2 mm width and pins of 0\.7 mm",
            r"up to 12\splates",
            r"0\.9 of the yield strength",
            r"\(1 \+ 6 e/l\) and the bending 32 F e/\(pi d³\)",
            r"a key from 6 mm on",
        ),
    },
    "docs/machine.md": {
        LIMIT: (r"poses to 1e-12", r"forces to 1e-6"),
    },
    "docs/measured.md": {
        TIME: (r"^\| (?:generate; prove|whole command|next to ncgears).*", r"which costs 7 %"),
        CAMPAIGN: (
            r"^## Many teeth\n(?:.*\n)*?(?=## Seats)",
            r"^## Seats\n(?:.*\n)*?(?=## B-splines)",
            r"^## B-splines\n(?:.*\n)*?(?=## Elsewhere)",
        ),
    },
    "docs/moving-box.md": {
        "printed by the paper": (r"prints 2\.1 mm", r"measured 2\.05 mm"),
        FORMULA: (
            r"\(theta - theta_0\)\).*",
            r"tan b = 2 pi R",
            r"kappa = [01]\b",
            r"d / 2",
            r"P < 0",
            r"w / 2",
            r"1 / (?=21)",
            r"w / sin\(2 lead",
            r"theta_0 = 0",
            r"m/s\^2",
            r"2 sqrt\(R\^2",
            r"\)\^2\)",
        ),
        INPUT: (
            r"slider 10 mm wide",
            r"(?:one|slider|bar of) 42 mm",
            r"w = 10 mm, R = 15 mm",
            r"at 12 deg",
            r"^\| (?:\d+ \| 1|\d+ \| [234])",
            r"^\| \d+(?= \|)",
            r"groove 2\.5 mm",
            r"for R = 15 mm and\na reach h of 3\.5 mm",
            r"at 180 deg less",
            r"at 200 r/min",
        ),
        LIMIT: (
            r"within 1e-7 mm",
            r"100 000 triangles",
            r"200 000 from",
            r"0\.004 mm for",
            r"than the 0\.1 mm",
        ),
        SIMULATED: (r"below 1e-12 mm", r"\| 0\.0006 mm", r"within 0\.2 %"),
        TIME: (r"^## Cost\n(?:.*\n)*?(?=## Limits)",),
    },
    "docs/proof.md": {
        INPUT: (r"at 17 points per piece",),
        LIMIT: (r"Within 4e-10 rad", r"a flank that touches 1 um out[^:]*1e-9 rad", r"fillet that is 1 um out"),
        PROOF: (
            r"some 1e-9 mm",
            r"\| [\d.]+ s(?= \|)",
            r"^\| (?:`two-stage`|`three-arm-all-goals`|`three-arm-from-poses`|the press of).*",
            r"\| \d+ \| [\d.]+ s \|$",
            r"the press took 236 s where it took 284 s",
            r"Of 1,000 defects",
            r"in 10 to 106 s of",
        ),
        "polygons of the outlines in shapely, by hand": (r"^Polygons of the outlines say the same.*",),
    },
    "docs/reverse.md": {
        LIMIT: (
            r"\(4 to 50,000\)",
            r"120 at most",
            r"above 4 MiB",
            r"within 1e-7 of",
            r"below 12,",
            r"below 315,",
            r"to 1e-10 rad",
            r"within 0\.1 mm",
            r"band of its own: 0 where",
            r"Of more than 24 points",
            r"up to 200 points",
            r"up to 1000 times the size",
            r"\(2 where it is left out\)",
        ),
        RUST: (r"near 1e-9 rad for q = 400", r"of a module of 0\.11 mm"),
        TIME: (r"^## What it costs\n(?:.*\n)*",),
        INPUT: (r"at \(260, 160\)", r"1 for round gears", r"nearer it stays to 1", r"ratio is nearest to 1"),
        FORMULA: (r"\(R \+ rho\)/2 and \(R - rho\)/2", r"\(carrier/2\)/cos\(bend/2\)", r"bend [-+] 180"),
    },
    "docs/strong-laws.md": {
        LIMIT: (r"most 1e-9 rad", r"up to 2e-5 rad", r"up to 600"),
        INPUT: (
            r"from 24 teeth on",
            r"1 \+ 0\.\d+ cos \d phi",
            r"of 20 degrees, module 1",
            r"14 teeth of module 2[^:]*modules",
        ),
        RUST: (r"with 414", r"23 degrees", r"^\| [a-z][\w ]+ \| \d+ \|.*"),
    },
    "docs/theory/contact.md": {
        FORMULA: (r"rate 1 \+",),
        LIMIT: (r"and 48 where", r"at 25 angles or more", r"It is 0 where"),
    },
    "docs/theory/feeder.md": {
        FORMULA: (r"</sub>, 0\)", r"from 0 to"),
        INPUT: (r"below 40 degrees", r"asks for 40", r"has 40 pitches and drives 30"),
    },
    "docs/theory/index.md": {
        FORMULA: (r"\(a, 0\)",),
        "year": (r"Press, 2004",),
    },
    "docs/theory/path.md": {
        FORMULA: (r"is 0/0 when",),
    },
    "docs/theory/pitch-curves.md": {
        "definition of the inch": (r"25\.4 mm / P",),
        LIMIT: (r"more than 16 times", r"needs 16 samples", r"below 0\.23 deg"),
        FORMULA: (
            r"is 1/2, as",
            r"i = 1/&phi;",
            r"a/\(1 \+ i\)",
            r"u = 1/r",
            r"\(1 \+ (?:1/)?i\)/a",
            r"runs 1/i",
            r"4 A E\(k\)",
            r"1/\(2 \+ &radic;3\)",
        ),
    },
    "docs/theory/spiral-shaft.md": {
        FORMULA: (r"phi;<sub>1</sub>, the groove", r"rad<sup>2</sup>.* / d", r"other box is 0"),
    },
    "docs/theory/teeth.md": {
        FORMULA: (
            r"&plusmn;1",
            r"m z/2",
            r", 2 h<sub>",
            r"k = 1/r",
            r"d<sup>2</sup>",
            r"<sup>2</sup> &alpha; \+ 2 d",
            r"h \(2 \+ k h\)",
        ),
        LIMIT: (r"from 0\.35 to 0\.65", r"from 14\.5 to 30 degrees", r"0\.002 pitches, 0\.001, and 0\.05 degrees"),
        INPUT: (r"with 14 teeth for the ratio 1 \+ 0\.4 cos 2 phi", r"\(23 degrees for a radius of 0\.38 modules\)"),
    },
    "docs/theory/three-arm.md": {
        FORMULA: (r"ratios 1\.", r"&lambda; = 0", r"goals 2 to\n4\.", r"1 when it is reached and\n1/\(1 \+"),
    },
    "docs/three-arm.md": {
        FORMULA: (r"ratios (?:are )?1\b", r"1 where it is reached and 1/\(1 \+"),
        "number of a standard": (r"EN 1993-1-8, 3\.5",),
        "number of a goal": (r"^\| \d(?:, \d)* \|",),
        "the (10) of the paper, as printed": (r"angle of about 80 degrees",),
        INPUT: (
            r"cam\. 30 deg",
            r"above 45 deg",
            r"S = 145 mm and H = 65 mm",
            r"above\n2\.5 mm",
            r"\"About 30 %",
            r"margin of 1 mm",
            r"carrier at 2 rad/s",
        ),
        SIMULATED: (r"stays within 0\.03 deg(?:.*\n)*?.*within 0\.40 deg", r"at 245 deg.*", r"back at 256 deg"),
        RUST: (
            r"<!-- readings -->\n(?:.*\n)*?<!-- end of readings -->",
            r"<!-- all goals -->\n(?:.*\n)*?<!-- end of all goals -->",
            r"the sun's 66 .*",
        ),
        "counted by the search named next to it": (
            r"after 4320 evaluations",
            r"after 3000 evaluations the module is still 85 %",
        ),
        LIMIT: (
            r"1\.2 diameters of its hole",
            r"grid of 0\.001 mm\nand 0\.001 degrees",
            r"goals 2 to 4 and 6 to 8",
            r"1e-9 for",
            r"to 1e-7 where.*",
        ),
        TIME: (
            r"about 0\.1 ms",
            r"^`executor=`(?:.*\n)*?(?=## Speed)",
            r"^\| (?:published|all goals), .*",
            r", 720 samples",
            r"720 poses",
        ),
        PEERS: (r"^2 to 4 and 6 to 8 of a machine.*",),
    },
    "docs/tutorial/1-laser.md": {
        INPUT: (r"sheet of 10 mm", r"than 0\.005 mm", r"\(1 [+-] k\)/\(1 - k\)"),
    },
    "docs/tutorial/2-your-own-law.md": {
        INPUT: (r"1 - 0\.25 cos", r"few 1e-15 rad"),
    },
    "docs/tutorial/4-compose.md": {
        INPUT: (r"to 1\. Round", r"1 to 1\."),
    },
    "docs/tutorial/6-simulate.md": {
        INPUT: (r"backlash of 0\.05 mm", r"at 2 rad/s"),
    },
    "docs/tutorial/index.md": {
        "number of a step": (r'<a href="[^"]*">\d</a>',),
    },
}

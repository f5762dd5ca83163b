import numpy as np

# A tapered lever of steel in mm, t, s: 200 long, 40 wide at the root and 20 at the tip, 6 thick.
LENGTH, ROOT, TIP, THICKNESS = 200.0, 40.0, 20.0, 6.0
COUNTS = (16, 4, 1)

# Twenty-node hexahedra: corners and middles of edges of a regular grid, in steps of half an element.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
PLACES = [*CORNERS, *(tuple((np.add(CORNERS[a], CORNERS[b]) // 2).tolist()) for a, b in EDGES)]

numbers, elements = {}, []
for cell in np.ndindex(COUNTS):
    places = [tuple(2 * np.array(cell) + place) for place in PLACES]
    elements.append([numbers.setdefault(place, len(numbers) + 1) for place in places])

nodes = {}
for place, number in numbers.items():
    x, y, z = np.array(place) / (2 * np.array(COUNTS))
    nodes[number] = (LENGTH * x, (ROOT + (TIP - ROOT) * x) * (y - 0.5), THICKNESS * (z - 0.5))
root = [number for number, (x, _, _) in nodes.items() if x < 1e-9]
tip = [number for number, (x, _, _) in nodes.items() if x > LENGTH - 1e-9]


def lines(rows):
    return "\n".join(",\n".join(", ".join(map(str, row[k : k + 10])) for k in range(0, len(row), 10)) for row in rows)


MODEL = f"""*NODE, NSET=ALL
{lines([(number, *place) for number, place in nodes.items()])}
*NSET, NSET=ROOT
{lines([root])}
*NSET, NSET=TIP
{lines([tip])}
*ELEMENT, TYPE=C3D20, ELSET=LEVER
{lines([(k + 1, *element) for k, element in enumerate(elements)])}
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.85e-9
*SOLID SECTION, ELSET=LEVER, MATERIAL=STEEL
"""
CLAMP = "*BOUNDARY\nROOT, 1, 3\n"
STEPS = {
    # The matrices of the free body, which `flexbody` reduces.
    "free": "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n",
    # Natural frequencies and a deflection of CalculiX itself, to compare with: 1 N at the tip.
    "clamped": f"{CLAMP}*STEP\n*FREQUENCY\n5\n*END STEP\n",
    "loaded": f"{CLAMP}*STEP\n*STATIC\n*CLOAD\nTIP, 3, {1 / len(tip)!r}\n*NODE PRINT, NSET=TIP\nU\n*END STEP\n",
}
for name, step in STEPS.items():
    with open(f"{name}.inp", "w", encoding="ascii") as file:
        file.write(MODEL + step)

from flexbody.reduction import Interface
from flexbody.reduction.readers import read_calculix

# Node sets of the input file.
sets = {}
with open("free.inp", encoding="ascii") as file:
    for line in file:
        if line.startswith("*"):
            _, _, name = line.strip().partition("*NSET, NSET=")
        elif name:
            sets.setdefault(name, []).extend(int(word) for word in line.split(",") if word.strip())

model = read_calculix("free", units="mm-t-s")
lever = model.reduce(
    {
        "root": Interface(model.indices(sets["ROOT"]), kind="rigid", held="frame"),
        "tip": Interface(model.indices(sets["TIP"]), held="position"),
    },
    modes=20,
)
lever.save("lever.safetensors")
print(lever.describe())

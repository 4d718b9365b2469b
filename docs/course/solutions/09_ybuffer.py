"""A solution of the checked exercise of lesson 9, ybuffer."""

segments = [
    ((2, 8), (30, 3), "r"),
    ((8, 2), (24, 9), "b"),
    ((14, 5), (38, 6), "y"),
    ((0, 6), (40, 6), "g"),
]
ybuffer = [float("-inf")] * 40
row = ["."] * 40
for (x0, z0), (x1, z1), color in segments:
    for column in range(x0, x1):
        t = (column + 0.5 - x0) / (x1 - x0)
        z = z0 + t * (z1 - z0)
        if z > ybuffer[column]:
            ybuffer[column] = z
            row[column] = color
print(row.count("g"))

"""A solution of the checked exercise of lesson 3, lines."""


def dda(x0, y0, x1, y1):
    count = max(abs(x1 - x0), abs(y1 - y0))
    x, y, pixels = x0 + 0.5, y0 + 0.5, []
    for _ in range(count + 1):
        pixels.append((int(x // 1), int(y // 1)))
        x, y = x + (x1 - x0) / count, y + (y1 - y0) / count
    return pixels


def bresenham(x0, y0, x1, y1):
    run, rise, step = x1 - x0, abs(y1 - y0), 1 if y0 < y1 else -1
    y, error, pixels = y0, run - (step > 0), []
    for x in range(x0, x1 + 1):
        pixels.append((x, y))
        error += 2 * rise
        if error >= 2 * run:
            y, error = y + step, error - 2 * run
    return pixels


lines = [(0, 0, 100, k) for k in range(101)]
print(sum(dda(*line) != bresenham(*line) for line in lines))

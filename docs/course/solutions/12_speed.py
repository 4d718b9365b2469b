"""A solution of the checked exercise of lesson 12, speed."""


def visited(left, right, lanes):
    first = left // lanes * lanes
    steps = range(first, right + 1, lanes)
    return [x + k for x in steps for k in range(lanes)]


print(len([x for x in visited(9, 36, 32) if not 9 <= x <= 36]))

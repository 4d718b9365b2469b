"""What a server for agents allows unless it is told otherwise; the command's help shows it."""

SECONDS = 60.0
MEGABYTES = 512
TRIANGLES = 20_000_000
#: Larger sides are no use to the models that look at pictures: they scale them down to this.
SIDE = 1568
MEGABYTE = 1 << 20

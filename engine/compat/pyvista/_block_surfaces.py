"""The surfaces that a mapper shows: one of a data set, one of each block of a composite.

In: a ``vtkMapper``. Out: ``vtkPolyData``, each with what its block changes of the actor's look.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from vtkmodules.vtkFiltersCore import vtkClipPolyData
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

from ...errors import warn
from ._properties import Property


def surfaces_of(mapper: Any, look: Property) -> Iterator[tuple[Any, Property]]:
    """Yield what a mapper shows, cut by its planes."""
    if mapper.GetNumberOfInputConnections(0):
        mapper.GetInputAlgorithm().Update()
    data = mapper.GetInputDataObject(0, 0)
    if data is None:
        return
    attributes = None
    if hasattr(mapper, "GetCompositeDataDisplayAttributes"):
        attributes = mapper.GetCompositeDataDisplayAttributes()
    for one, changed in _leaves(data, look, attributes):
        surface = _surface(one)
        if surface is not None:
            yield _cut(surface, mapper.GetClippingPlanes()), changed


def _leaves(data: Any, look: Property, attributes: Any) -> Iterator[tuple[Any, Property]]:
    """Yield the data sets of a composite with the looks of their blocks."""
    if attributes is not None:
        if attributes.HasBlockVisibility(data) and not attributes.GetBlockVisibility(data):
            return
        if attributes.HasBlockColor(data):
            color = np.array(attributes.GetBlockColor(data))
            look = replace(look, color=color, ambient_color=color)
        if attributes.HasBlockOpacity(data):
            look = replace(look, opacity=attributes.GetBlockOpacity(data))
    if data.IsA("vtkMultiBlockDataSet"):
        children = [data.GetBlock(k) for k in range(data.GetNumberOfBlocks())]
    elif data.IsA("vtkPartitionedDataSetCollection"):
        children = [
            data.GetPartitionedDataSet(k) for k in range(data.GetNumberOfPartitionedDataSets())
        ]
    elif data.IsA("vtkPartitionedDataSet"):
        children = [data.GetPartition(k) for k in range(data.GetNumberOfPartitions())]
    else:
        yield data, look
        return
    for child in children:
        if child is not None:
            yield from _leaves(child, look, attributes)


def _surface(data: Any) -> Any:
    """Return the outer faces of a data set as a ``vtkPolyData``; None of what has no points."""
    if data.IsA("vtkPolyData"):
        return data if data.GetPoints() is not None else None
    if not data.IsA("vtkDataSet"):
        warn(f"a {data.GetClassName()} is not drawn: it is no data set with points")
        return None
    outside = vtkDataSetSurfaceFilter()
    outside.SetInputData(data)
    outside.PassThroughPointIdsOff()
    outside.PassThroughCellIdsOff()
    outside.Update()
    found = outside.GetOutput()
    return found if found.GetPoints() is not None else None


def _cut(surface: Any, planes: Any) -> Any:
    """Return a surface without what clipping planes hide."""
    if planes is None:
        return surface
    for k in range(planes.GetNumberOfItems()):
        cut = vtkClipPolyData()
        cut.SetInputData(surface)
        cut.SetClipFunction(planes.GetItem(k))
        cut.Update()
        surface = cut.GetOutput()
    return surface

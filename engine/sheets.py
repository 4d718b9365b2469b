"""Contact sheets: a model from several sides on one picture, with a report."""

from .apps.sheet.contact_sheet import Sheet, contact_sheet

__all__ = ["Sheet", "contact_sheet"]

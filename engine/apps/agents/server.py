"""The server: publishes tools and resources by the Model Context Protocol.

In: limits. Out: an `MCPServer` of the package mcp. Calls run one after the other in the thread of
the event loop, so that an alarm can end one that takes too long. Each tool's result has its record
as structured content and, for clients that know no such, as text.
"""

from __future__ import annotations

import base64
import inspect
import json
import math
import re
import traceback
from collections.abc import Callable
from typing import Annotated, Any

from mcp.server.mcpserver import MCPServer
from mcp.server.mcpserver.tools import Tool as PublishedTool
from mcp.types import CallToolResult, ImageContent, TextContent, ToolAnnotations
from pydantic import ValidationError

from ...base.near_words import meant
from ...base.numbers import shown
from ...base.warning_scopes import gathered
from ...errors import Engine3DError, printable
from ...version import __version__
from .server_limits import Limits
from .session import Session
from .tools import Answer, Tool, tools_of

_INSTRUCTIONS = (
    "Draws and measures 3D models on the CPU. load a file, then views or render; pick tells what "
    "is at a pixel. Coordinates are those of the files. Pixels count from the top left."
)
#: Letters of an error.
_MOST_SAID = 500


class AgentTool(PublishedTool):
    """A tool whose errors are engine3d's own words, and which refuses unknown arguments."""

    async def run(
        self, arguments: dict[str, Any], context: Any, convert_result: bool = False
    ) -> CallToolResult:
        known = self.parameters["properties"]
        for word in arguments:
            if word not in known:
                hint = meant(word, known)
                return _failed(f"{self.name} has no argument {shown(word)}{hint}")
        try:
            checked = self.fn_metadata.validate_arguments(arguments)
        except ValidationError as error:
            return _failed(_refused(self.name, error))
        result: CallToolResult = self.fn(**checked)
        return result


class Server(MCPServer[Any]):
    """A server that suggests the nearest of its tools where one is unknown."""

    async def call_tool(self, name: str, arguments: dict[str, Any], context: Any = None) -> Any:
        known = [tool.name for tool in await self.list_tools()]
        if name not in known:
            return _failed(f"there is no tool {shown(name)}{meant(name, known)}")
        return await super().call_tool(name, arguments, context)


def server_for(session: Session) -> Server:
    """Return the server of a session, with all its tools and resources."""
    server = Server(
        "engine3d",
        title="engine3d",
        version=__version__,
        instructions=_INSTRUCTIONS,
        tools=[_published(tool, session) for tool in tools_of(session)],
        log_level="ERROR",
    )

    @server.resource(
        "engine3d://scene", name="scene", description="the objects", mime_type="application/json"
    )
    async def scene() -> str:
        return _json(session.record())

    @server.resource(
        "engine3d://render/last.png",
        name="last picture",
        description="what was drawn last",
        mime_type="image/png",
    )
    async def last() -> bytes:
        if session.last is None:
            raise ValueError("there is no picture yet: call render first")
        return session.last.encode()

    return server


def serve(limits: Limits) -> None:
    """Serve one client on standard input and output until it leaves."""
    session = Session(limits)
    try:
        server_for(session).run("stdio")
    finally:
        session.studio.close()


def _published(tool: Tool, session: Session) -> AgentTool:
    def call(**arguments: Any) -> CallToolResult:
        return _result(lambda: tool.call(**arguments), session.limits)

    call.__name__, call.__doc__ = tool.call.__name__, _one_line(tool.call.__doc__ or "")
    signature: Any = inspect.signature(tool.call, eval_str=True)
    returns = Annotated[CallToolResult, tool.record]
    vars(call)["__signature__"] = signature.replace(return_annotation=returns)
    hints = ToolAnnotations(read_only_hint=tool.reads, open_world_hint=False)
    published = AgentTool.from_function(call, annotations=hints)
    published.parameters = _without_titles(published.parameters)
    published.parameters["additionalProperties"] = False
    published.fn_metadata.output_schema = _without_titles(published.fn_metadata.output_schema)
    return published


def _result(call: Callable[[], Answer], limits: Limits) -> CallToolResult:
    """Return what a tool answers, or its error."""
    try:
        with gathered() as said, limits.in_time():
            answer = call()
    except Engine3DError as error:
        return _failed(limits.with_short_names(str(error)))
    except MemoryError:
        return _failed("out of memory")
    except OSError as error:
        return _failed(printable(error.strerror or str(error)))
    except (Exception, SystemExit) as error:  # no library ends the server
        traceback.print_exc()  # on standard error, for a report of the fault
        return _failed(f"a fault of engine3d: {type(error).__name__}: {printable(str(error))}")
    record = dict(answer.record)
    told = [limits.with_short_names(printable(text)) for text in said]
    known = [limits.with_short_names(line) for line in record.get("warnings", [])]
    fresh = [line for line in dict.fromkeys(told) if not any(line.endswith(k) for k in known)]
    if "warnings" in record:
        record["warnings"] = [*known, *fresh]
    record = _finite(record)
    texts = [_json(record), *(f"warning: {line}" for line in fresh if "warnings" not in record)]
    content: list[Any] = [TextContent(type="text", text="\n".join(texts))]
    if answer.picture is not None:
        data = base64.b64encode(answer.picture).decode("ascii")
        content.insert(0, ImageContent(type="image", data=data, mime_type=answer.kind))
    return CallToolResult(content=content, structured_content=record)


def _failed(message: str) -> CallToolResult:
    """Return an error; one that repeats very long arguments is cut short."""
    if len(message) > _MOST_SAID:
        message = f"{message[: _MOST_SAID // 2]} ... {message[-_MOST_SAID // 4 :]}"
    return CallToolResult(content=[TextContent(type="text", text=message)], is_error=True)


def _refused(name: str, error: ValidationError) -> str:
    """Return the first fault of arguments in a line."""
    first = error.errors(include_url=False)[0]
    place = ".".join(str(part) for part in first["loc"][:1])
    return f"{name}: {place}: {first['msg'][0].lower()}{first['msg'][1:]}"


def _json(record: Any) -> str:
    return json.dumps(record, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def _finite(value: Any) -> Any:
    """Return JSON types with null in place of numbers that JSON lacks."""
    if isinstance(value, dict):
        return {key: _finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _without_titles(schema: Any) -> Any:
    """Return a schema without the titles that repeat its names, which cost agents words."""
    if isinstance(schema, list):
        return [_without_titles(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    return {
        key: {name: _without_titles(one) for name, one in value.items()}
        if key in ("properties", "$defs")
        else _without_titles(value)
        for key, value in schema.items()
        if key not in ("title", "additionalProperties")
    }


def _one_line(text: str) -> str:
    return re.sub(r"\s+", " ", text).strip()

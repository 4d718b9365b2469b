"""Runs a program of WebAssembly for WASI by PyPI's `wasmtime`: `run_wasm.py PROGRAM [ARGUMENT]...`.

It sees its arguments and the standard streams, no file and no network.
"""

import sys

import wasmtime


def main(program, *arguments):
    engine = wasmtime.Engine()
    linker = wasmtime.Linker(engine)
    linker.define_wasi()
    store = wasmtime.Store(engine)
    wasi = wasmtime.WasiConfig()
    wasi.argv = [program, *arguments]
    wasi.inherit_stdout()
    wasi.inherit_stderr()
    store.set_wasi(wasi)
    started = linker.instantiate(store, wasmtime.Module.from_file(engine, program))
    try:
        started.exports(store)["_start"](store)
    except wasmtime.ExitTrap as ended:
        sys.exit(ended.code)


if __name__ == "__main__":
    main(*sys.argv[1:])

"""Reads the quantities and effects of a stored run (harness/run/run_store.cpp)."""

import ctypes
import struct

FLOATS = {25: ">e", 26: ">f", 27: ">d"}


def decode(data, at=0):
    """Returns the value at a position, and the position after it."""
    major, info = data[at] >> 5, data[at] & 31
    at += 1
    if major == 7:
        if info in FLOATS:
            return struct.unpack_from(FLOATS[info], data, at)[0], at + struct.calcsize(FLOATS[info])
        return {20: False, 21: True}.get(info), at
    if info >= 24:
        size = 1 << (info - 24)
        info, at = int.from_bytes(data[at:at + size], "big"), at + size
    if major < 2:
        return (info if major == 0 else -1 - info), at
    if major < 4:
        return (data[at:at + info] if major == 2 else data[at:at + info].decode()), at + info
    values = []
    for _ in range(info * (2 if major == 5 else 1)):
        value, at = decode(data, at)
        values.append(value)
    return (values if major == 4 else dict(zip(values[::2], values[1::2]))), at


def uncompressed(data):
    zstd = ctypes.CDLL("libzstd.so.1")
    zstd.ZSTD_getFrameContentSize.restype = ctypes.c_ulonglong
    out = ctypes.create_string_buffer(zstd.ZSTD_getFrameContentSize(data, len(data)))
    zstd.ZSTD_decompress(out, ctypes.c_size_t(len(out)), data, ctypes.c_size_t(len(data)))
    return out.raw


def numbers(data):
    # Each number is stored as the difference from the number two positions before: first the lowest bytes of all differences, then the next.
    count = len(data) // 8
    bits = [int.from_bytes(data[i::count], "little") for i in range(count)]
    for i in range(2, count):
        bits[i] = (bits[i] + bits[i - 2]) % 2**64
    return struct.unpack(f"<{count}d", struct.pack(f"<{count}Q", *bits))


def read_run(path):
    """Returns quantities (name -> numbers), the largest relative round-off error of each, and [effect, is active] pairs."""
    run = decode(uncompressed(path.read_bytes()))[0]
    entries = run["quantities"]  # name, values and errors in turn
    quantities = {name: numbers(values) for name, values in zip(entries[::3], entries[1::3])}
    roundoff = {name: max(numbers(errors), default=0.0) for name, errors in zip(entries[::3], entries[2::3])}
    return quantities, roundoff, [[effect["effect"], effect["active"]] for effect in run.get("effects", [])]

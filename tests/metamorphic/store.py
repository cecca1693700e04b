"""Reads the quantities and effects of a stored run (harness/run/run_store.cpp)."""

import struct

FLOATS = {25: (">e", 2), 26: (">f", 4), 27: (">d", 8)}


def decode(data, at=0):
    """Returns the value that begins at a position, and the position behind it."""
    major, info = data[at] >> 5, data[at] & 31
    at += 1
    if major == 7:
        if info in FLOATS:
            code, size = FLOATS[info]
            return struct.unpack(code, data[at:at + size])[0], at + size
        return {20: False, 21: True}.get(info), at
    if info >= 24:
        size = 1 << (info - 24)
        info, at = int.from_bytes(data[at:at + size], "big"), at + size
    if major < 2:
        return (info if major == 0 else -1 - info), at
    if major < 4:
        text = data[at:at + info]
        return (text if major == 2 else text.decode()), at + info
    if major == 6:
        return decode(data, at)
    values = []
    for _ in range(info * (2 if major == 5 else 1)):
        value, at = decode(data, at)
        values.append(value)
    return (values if major == 4 else dict(zip(values[::2], values[1::2]))), at


def read_run(path):
    """Returns the quantities (name -> list of numbers), their relative round-off errors (name -> the largest that the
    program states) and which effects are active."""
    data = path.read_bytes()
    numbers = data[16:16 + struct.unpack("<Q", data[8:16])[0]]  # behind checksum and length
    outcome = decode(data, 16 + len(numbers))[0][3]
    names, (start, size) = outcome[2]
    lengths = struct.unpack(f"<{size // 8}Q", numbers[start:start + size])
    quantities, roundoff, letter, start = {}, {}, 0, lengths[0]

    def read(size):
        nonlocal start
        start += size
        return struct.unpack(f"<{size // 8}d", numbers[start - size:start])

    for length, values, errors in zip(lengths[1::3], lengths[2::3], lengths[3::3]):
        name, letter = names[letter:letter + length], letter + length
        quantities[name] = read(values)
        roundoff[name] = max(read(errors), default=0.0)
    effects = next((item[0] for item in zip(outcome[7:], outcome[6:]) if isinstance(item[1], str)), [])
    return quantities, roundoff, [effect[:2] for effect in effects if isinstance(effect, list)]

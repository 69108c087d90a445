"""Reads what adsdv wrote as MCAP: every checksum, every message, and what the summary and the indexes say of them."""

import collections
import json
import struct
import sys
import zlib

import jsonschema
from mcap.reader import NonSeekingReader, make_reader

with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, validate_crcs=True)
    assert reader.get_header().library.startswith("adsdv ")
    summary = reader.get_summary()
    assert summary is not None and summary.statistics is not None
    statistics = summary.statistics
    validators, counts, frames, times = {}, collections.Counter(), 0, []
    for schema, channel, message in reader.iter_messages():
        counts[channel.id] += 1
        times.append(message.log_time)
        if channel.message_encoding == "json":
            assert schema.encoding == "jsonschema"
            if schema.id not in validators:
                definition = json.loads(schema.data)
                jsonschema.Draft202012Validator.check_schema(definition)
                validators[schema.id] = jsonschema.Draft202012Validator(definition | {"additionalProperties": False})
            validators[schema.id].validate(json.loads(message.data))
        else:
            assert (channel.message_encoding, schema.encoding) == ("cdr", "ros2msg")
            frames += 1
    assert times == sorted(times), "the reader sorts by the index"
    assert statistics.message_count == len(times) == sum(counts.values())
    assert {id: count for id, count in statistics.channel_message_counts.items() if count} == dict(counts)
    assert (statistics.message_start_time, statistics.message_end_time) == (times[0], times[-1])
    assert (statistics.channel_count, statistics.schema_count) == (len(summary.channels), len(summary.schemas))
    assert statistics.chunk_count == len(summary.chunk_indexes)
    for index in summary.chunk_indexes:
        assert index.compression == "lz4" and index.message_index_offsets

    # By the index alone: a topic, and a part of the time.
    middle = (times[0] + times[-1]) // 2
    for topic in ("/adsdv/as_state", "/adsdv/VCU2AI_Status"):
        channel = next(channel for channel in summary.channels.values() if channel.topic == topic)
        of_topic = list(reader.iter_messages(topics=topic))
        assert len(of_topic) == counts[channel.id] > 0, topic
        late = list(reader.iter_messages(topics=topic, start_time=middle))
        assert late == [message for message in of_topic if message[2].log_time >= middle]

# The checksums that the reader passes over: of the data, and of the summary with the begin of the footer.
with open(sys.argv[1], "rb") as file:
    content = file.read()
summary_start, _, summary_crc = struct.unpack("<QQI", content[-28:-8])
data_end = summary_start - 13
assert content[data_end] == 0x0F
assert struct.unpack_from("<I", content, data_end + 9)[0] == zlib.crc32(content[:data_end]) != 0
assert summary_crc == zlib.crc32(content[summary_start:-12])

# Whoever cannot seek comes to the same.
with open(sys.argv[1], "rb") as file:
    streamed = sum(1 for _ in NonSeekingReader(file, validate_crcs=True).iter_messages())
assert streamed == len(times)
print(f"{frames} frames, {len(times)} messages, {len(summary.chunk_indexes)} chunks, {len(summary.channels)} channels")

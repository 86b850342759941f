// Reads an MCAP file with the format's own reader, checksums included, and
// holds each message against Foxglove's schema of that name:
//   node read.mjs FILE
// Prints how many messages there are; exits with 1 if anything is wrong.
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import official from "@foxglove/schemas/jsonschema.js";

const published = new Map(
  Object.values(official).filter((x) => x?.title).map((x) => [x.title, x]));

// wrong(value, schema): what does not fit, or nothing.
function wrong(value, schema, where = "") {
  if (schema.type === "array" || Array.isArray(value)) {
    if (!Array.isArray(value)) return `${where} is no list`;
    for (const [i, x] of value.entries()) {
      const why = wrong(x, schema.items ?? {}, `${where}[${i}]`);
      if (why) return why;
    }
    return "";
  }
  if (schema.properties) {
    if (typeof value !== "object") return `${where} is no object`;
    for (const name of schema.required ?? [])
      if (!(name in value)) return `${where}.${name} is missing`;
    for (const [name, x] of Object.entries(value)) {
      const field = schema.properties[name];
      if (!field) return `${where}.${name} is unknown`;
      const why = wrong(x, field, `${where}.${name}`);
      if (why) return why;
    }
    return "";
  }
  if (["number", "integer"].includes(schema.type) && typeof value !== "number")
    return `${where} is no number`;
  if (schema.type === "string" && typeof value !== "string")
    return `${where} is no text`;
  return "";
}

const file = await open(process.argv[2], "r");
const reader = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(file),
});
let count = 0, held = 0, last = 0n;
const fail = (why) => {
  console.log(why);
  process.exit(1);
};
const decoder = new TextDecoder();
for await (const message of reader.readMessages({ validateCrcs: true })) {
  if (message.logTime < last) fail(`message ${count} is out of order`);
  last = message.logTime;
  ++count;
  const channel = reader.channelsById.get(message.channelId);
  const name = reader.schemasById.get(channel.schemaId).name;
  const schema = published.get(name.replace("foxglove.", ""))
    ?? published.get(name);
  const value = JSON.parse(decoder.decode(message.data));
  if (name.startsWith("foxglove.") && !schema) fail(`${name} is no schema`);
  if (!schema) continue;
  const why = wrong(value, schema, channel.topic);
  if (why) fail(why);
  ++held;
}
if (BigInt(count) !== reader.statistics.messageCount)
  fail(`${count} of ${reader.statistics.messageCount} were read`);
console.log(`${count} messages, ${held} as Foxglove has them`);

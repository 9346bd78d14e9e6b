// Messages as a distribution of ROS 2 defines them, by @foxglove/rosmsg2-serialization, through our types and back:
// node distributions.mjs NODE_MODULES DISTRIBUTION OUR_IDL ROUND_TRIP DOMAIN
// Prints {"TYPE": {"fields", "read", "written"}}. fields: ours are theirs, by name, type and order. read: what Cairn reads
// of their messages is what they wrote. written: their reader decodes what was sent.
// Each is "same" or what is not.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [modules, distribution, idl, roundTrip, domain] = process.argv.slice(2);
const require = createRequire(join(modules, 'node_modules', 'index.js'));
const { parseIDL } = require('@foxglove/omgidl-parser');
const { MessageReader, MessageWriter } = require('@foxglove/rosmsg2-serialization');
const theirs = Object.fromEntries(
  Object.entries(require('@foxglove/rosmsg-msgs-common')[distribution]).map(([name, { definitions }]) => [name, { name, definitions: definitions.map(named) }]),
);
const messagesOfAType = 20;

// The package writes `time` for what is a message in ROS 2.
function named(field) {
  const message = { time: 'builtin_interfaces/Time', duration: 'builtin_interfaces/Duration' }[field.type];
  return message ? { ...field, type: message, isComplex: true } : field;
}

const rosName = (name) => name.replace('::msg::dds_::', '/').replace(/_$/, '');
const structs = parseIDL(readFileSync(idl, 'utf8')).filter((type) => type.aggregatedKind === 'struct');
const ours = Object.fromEntries(
  structs.map(({ name, definitions }) => [
    rosName(name),
    {
      name: rosName(name),
      definitions: definitions.map(({ name: field, type, isComplex, isArray, arrayLengths }) => ({
        name: field,
        type: isComplex ? rosName(type) : type,
        isComplex,
        isArray: Boolean(isArray || arrayLengths),
        arrayLength: arrayLengths?.[0],
      })),
    },
  ]),
);
const topics = structs.filter(({ annotations }) => annotations?.topic).map(({ name }) => rosName(name));

const fieldsOf = (all, name) => all[name].definitions.filter(({ isConstant }) => !isConstant);

// A type and all that it is made of, itself first.
function withParts(all, name, seen = new Map()) {
  if (seen.has(name)) return seen;
  if (!all[name]) throw new Error(`no ${name} in ${distribution}`);
  seen.set(name, { name, definitions: all[name].definitions });
  for (const { type, isComplex } of fieldsOf(all, name)) if (isComplex) withParts(all, type, seen);
  return seen;
}
const definitionsOf = (all, name) => [...withParts(all, name).values()].map((part, i) => (i === 0 ? { definitions: part.definitions } : part));

const fieldText = ({ name, type, isArray, arrayLength }) => `${type}${isArray ? `[${arrayLength ?? ''}]` : ''} ${name}`;

// Where ours has octet, ROS has int8 or byte: DDS's IDL has no 8 bit number with a sign.
function differentFields(name) {
  for (const part of withParts(ours, name).keys()) {
    const [our, their] = [ours, theirs].map((all) => (all[part] ? fieldsOf(all, part).map(fieldText) : []));
    const texts = [our, their].map((texts) => texts.map((text) => text.replace(/^int8\b/, 'uint8')));
    const at = texts[1].findIndex((text, i) => text !== texts[0][i]);
    if (at >= 0) return `${part}: ${their[at]}, and ours has ${our[at] ?? 'nothing'}`;
    if (our.length > their.length) return `${part}: ours has ${our[their.length]}`;
  }
  return 'same';
}

// The same numbers for everybody (mulberry32).
let state = 7;
function random(below) {
  state = (state + 0x6d2b79f5) | 0;
  let t = Math.imul(state ^ (state >>> 15), 1 | state);
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
  return Math.floor((((t ^ (t >>> 14)) >>> 0) / 4294967296) * below);
}

const basic = {
  bool: () => random(2) === 1,
  int8: () => random(256) - 128,
  uint8: () => random(256),
  int16: () => random(65536) - 32768,
  uint16: () => random(65536),
  int32: () => random(4294967296) - 2147483648,
  uint32: () => random(4294967296),
  float32: () => Math.fround(random(2000000) / 1000 - 1000),
  float64: () => random(4294967296) / 1000 - 1e6,
  string: () => 'base_link'.slice(0, random(10)),
};

function one({ type, isComplex }) {
  return isComplex ? message(type) : basic[type]();
}
function message(name) {
  return Object.fromEntries(
    fieldsOf(theirs, name).map((field) => [
      field.name,
      field.isArray ? Array.from({ length: field.arrayLength ?? random(4) }, () => one(field)) : one(field),
    ]),
  );
}

const isList = (value) => Array.isArray(value) || ArrayBuffer.isView(value);
const byte = (value) => (typeof value === 'number' && value < 0 && value >= -128 && Number.isInteger(value) ? value + 256 : value);

// Where two messages differ, of the fields that `all` has; nowhere: undefined.
function difference(got, wanted, all, type, path = type) {
  for (const field of fieldsOf(all, type)) {
    const [a, b] = [got[field.name], wanted[field.name]];
    const [listA, listB] = field.isArray ? [a, b] : [[a], [b]];
    if (!isList(listA) || listA.length !== listB.length) return `${path}.${field.name}: another length`;
    for (let i = 0; i < listB.length; ++i) {
      const at = `${path}.${field.name}`;
      const isByte = /^u?int8$/.test(field.type);
      if (field.isComplex) {
        const found = difference(listA[i], listB[i], all, field.type, at);
        if (found) return found;
      } else if ((isByte ? byte(listA[i]) : listA[i]) !== (isByte ? byte(listB[i]) : listB[i])) {
        return `${at}: ${listA[i]}, not ${listB[i]}`;
      }
    }
  }
  return undefined;
}

function counted(bytes) {
  const count = Buffer.alloc(4);
  count.writeUInt32LE(bytes.length);
  return Buffer.concat([count, bytes]);
}

function passedThrough(name, messages) {
  const writer = new MessageWriter(definitionsOf(theirs, name));
  const input = Buffer.concat(messages.flatMap((each) => [counted(Buffer.from(name)), counted(Buffer.from(writer.writeMessage(each)))]));
  const output = execFileSync(roundTrip, [domain], { input, maxBuffer: 1 << 26 });
  const all = [];
  for (let at = 0; at < output.length; ) {
    const size = output.readUInt32LE(at);
    all.push(output.subarray(at + 4, at + 4 + size));
    at += 4 + size;
  }
  return all;
}

// What is wrong with the first of them that is not read as it was written.
function firstWrong(reader, all, passed, messages, name) {
  for (let i = 0; i < messages.length; ++i) {
    if (passed[i].length === 0) return 'refused';
    try {
      const found = difference(reader.readMessage(passed[i]), messages[i], all, name);
      if (found) return found;
    } catch (error) {
      return String(error.message);
    }
  }
  return 'same';
}

const found = {};
for (const name of topics) {
  const messages = Array.from({ length: messagesOfAType }, () => message(name));
  const passed = passedThrough(name, messages);
  found[name] = {
    fields: differentFields(name),
    read: firstWrong(new MessageReader(definitionsOf(ours, name)), ours, passed, messages, name),
    written: firstWrong(new MessageReader(definitionsOf(theirs, name)), theirs, passed, messages, name),
  };
}
console.log(JSON.stringify(found));

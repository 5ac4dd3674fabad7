// Fields of a message that tell something: those of all messages of a protocol are left out.
export type Field = [string, string, string]; // name, value, unit

const frame = /^(start2?|checksum|end|length|payload_length|reserved\w*|spare\w*)$/;
const address = /^(id|source|destination|packet_name|packet_size|stream_id|total_count)$/;

export function telling(fields: Field[]): Field[] {
  return fields.filter(([name]) => !frame.test(name));
}

/** For one line, which tells the message and its way already. */
export function mostTelling(fields: Field[], message: string): Field[] {
  return telling(fields).filter(([name, text]) => !address.test(name) && text !== message);
}

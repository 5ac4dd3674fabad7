-- Packets {"RIP1" or "RIP2", u32 length, payload, CRC-32}; the payload of RIP2 is a Snappy block.
local family = sonar.families.sonar3d
local T = family.tables
local payload_at, crc_bytes, longest = 8, 4, 16 * 1024 * 1024
local frame = T.Frame.rows_by_name

family.mark = "R"

function family.frame(text, at)
  local id = text:sub(at + 1, at + 4)
  if id ~= ("RIP1"):sub(1, #id) and id ~= ("RIP2"):sub(1, #id) then return 0 end
  local size = sonar.le(text, at + 4, 4)
  if not size then return nil end
  return size >= payload_at + crc_bytes and size <= longest and size or 0
end

-- Literals and copies of a Snappy block; nil if it is none or longer than it says or than a packet may be.
local function uncompressed(text)
  local most, at = 0, 0
  for shift = 0, 4 do
    local byte = text:byte(at + 1)
    if not byte then return nil end
    at, most = at + 1, most + byte % 128 * 2 ^ (7 * shift)
    if byte < 128 then break end
  end
  if most > longest then return nil end
  local out, count = {}, 0
  local function copy(offset, length)
    if offset < 1 or offset > count or count + length > most then return false end
    for _ = 1, length do
      count = count + 1
      out[count] = out[count - offset]
    end
    return true
  end
  local function literal(size)
    if at + size > #text or count + size > most then return false end
    for i = 1, size do out[count + i] = text:sub(at + i, at + i) end
    at, count = at + size, count + size
    return true
  end
  while at < #text do
    local tag = text:byte(at + 1)
    local kind, size = tag % 4, math.floor(tag / 4)
    at = at + 1
    if kind == 0 then
      if size >= 60 then
        local more = size - 59
        size = sonar.le(text, at, more)
        at = at + more
      end
      if not size or not literal(size + 1) then return nil end
    elseif kind == 1 then
      local low = text:byte(at + 1)
      at = at + 1
      if not low or not copy(math.floor(size / 8) * 256 + low, size % 8 + 4) then return nil end
    else
      local bytes = kind == 2 and 2 or 4
      local offset = sonar.le(text, at, bytes)
      at = at + bytes
      if not offset or not copy(offset, size + 1) then return nil end
    end
  end
  return count == most and table.concat(out) or nil
end

local function message_name(url) return url:match("[^./]*$") end

-- Shows the message within the Any that the payload is; returns its name.
local function show_payload(tree, tvb, text, at, stop)
  local name = "Packet"
  local parts = {}
  function parts.type_url(item, buffer, bytes, from, to)
    local url = bytes:sub(from + 1, to)
    item:add(T.Any.rows_by_name.type_url.field, buffer(from, to - from), sonar.printable(url))
    name = sonar.printable(message_name(url))
  end
  function parts.value(item, buffer, bytes, from, to)
    local sub = item:add(T.Any.rows_by_name.value.field, buffer(from, to - from))
    if T[name] and T[name] ~= T.Any then sonar.show_protobuf(family, sub, T[name], buffer, bytes, from, to) end
  end
  sonar.show_protobuf(family, tree, T.Packet, tvb, text, at, stop, parts)
  return name
end

function family.display(tree, tvb, at, size, text)
  local id, crc_at = text:sub(at + 1, at + 4), at + size - crc_bytes
  tree:add(frame.id.field, tvb(at, 4), id)
  tree:add_le(frame.length.field, tvb(at + 4, 4))
  local crc = tree:add_le(frame.checksum.field, tvb(crc_at, crc_bytes))
  sonar.check(crc, "checksum", sonar.le(text, crc_at, crc_bytes), sonar.crc32(text:sub(at + 1, crc_at)))
  if id == "RIP1" then return show_payload(tree, tvb, text, at + payload_at, crc_at) end
  local plain = uncompressed(text:sub(at + payload_at + 1, crc_at))
  if not plain or plain == "" then
    sonar.fault(tree, "payload: no Snappy block")
    return id
  end
  return show_payload(tree, ByteArray.new(plain, true):tvb("Uncompressed"), plain, 0, #plain)
end

function family.sign(text) return #text > payload_at and (family.frame(text, 0) or 0) > 0 end

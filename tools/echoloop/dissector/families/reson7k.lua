-- Records {record frame, content, u32 sum}; on a network each in packets with a network frame before each part.
local family = sonar.families.reson7k
local network, record, checksum, longest = 36, 64, 4, 64 * 1024 * 1024
local sync = 0x0000FFFF
local T = family.tables
local sum_field = ProtoField.uint32("sonar.reson7k.checksum", "checksum", base.HEX, nil, 0, "sum of all bytes before it")
table.insert(family.fields, sum_field)

-- The tables begin their help with the number of the record.
local names = {}
for name, tab in pairs(T) do
  local number = tab.help:match("^(7%d%d%d)")
  if number and name ~= "Settings" then names[tonumber(number)] = name end
end

family.mark = "\5"

local function number(text, at, name, row_name)
  local row = T[name].rows_by_name[row_name]
  return sonar.le(text, at + row.offset, sonar.size_of(row))
end

-- Bytes of the record whose frame is here; 0: none; nil: not to be told yet.
local function record_size(text, at)
  local version, offset, mark = sonar.le(text, at, 2), sonar.le(text, at + 2, 2), sonar.le(text, at + 4, 4)
  if (version or 5) ~= 5 or (offset or 60) ~= 60 or (mark or sync) ~= sync then return 0 end
  local size = number(text, at, "RecordFrame", "size")
  if not size then return nil end
  return size >= record + checksum and size <= longest and size or 0
end

local function is_network(text, at)
  return (sonar.le(text, at, 2) or 5) == 5 and (sonar.le(text, at + 2, 2) or network) == network
end

-- {at, size} of the packets' data and the bytes of all packets of the record that begins here.
local function packets(text, at)
  local parts, total, from = {}, 0, at
  local first = {}
  repeat
    if not is_network(text, from) then return nil, 0 end
    local size, all = number(text, from, "NetworkFrame", "packet_size"), number(text, from, "NetworkFrame", "total_size")
    if not size or not all then return nil, nil end
    local sequence = number(text, from, "NetworkFrame", "sequence")
    if size <= network or size > 65535 or sequence ~= #parts or all > longest or (first.all or all) ~= all then return nil, 0 end
    first.all = all
    table.insert(parts, {from + network, size - network})
    total, from = total + size - network, from + size
  until total >= all
  if total > first.all then return nil, 0 end
  return parts, from - at, first.all
end

function family.frame(text, at)
  if text:byte(at + 1) ~= 5 then return 0 end
  if not is_network(text, at) then return record_size(text, at) end
  local _, size = packets(text, at)
  return size
end

local function show_record(tree, tvb, at, size, text)
  sonar.walk(sonar.reader(family, tvb, at, at + record), T.RecordFrame, tree)
  local kind, flags = number(text, at, "RecordFrame", "type"), number(text, at, "RecordFrame", "flags")
  local name, stop = names[kind], at + size - checksum
  if name then
    sonar.show(family, tree, name, tvb, at + record, stop)
  else
    sonar.fault(tree, "no record that is known")
  end
  local item = tree:add_le(sum_field, tvb(stop, checksum))
  if flags % 2 == 1 then sonar.check(item, "checksum", sonar.le(text, stop, 4), sonar.sum(text:sub(at + 1, stop)) % 2 ^ 32) end
  return name or "record " .. kind
end

local function show_parts(tree, tvb, text, parts)
  local bytes = {}
  for _, part in ipairs(parts) do
    local item = tree:add(family.proto, tvb(part[1] - network, network), "Network frame")
    sonar.walk(sonar.reader(family, tvb, part[1] - network, part[1]), T.NetworkFrame, item)
    table.insert(bytes, text:sub(part[1] + 1, part[1] + part[2]))
  end
  return table.concat(bytes)
end

function family.display(tree, tvb, at, size, text)
  if not is_network(text, at) then return show_record(tree, tvb, at, size, text) end
  local parts = packets(text, at)
  local whole = show_parts(tree, tvb, text, parts)
  if record_size(whole, 0) ~= #whole then
    sonar.fault(tree, "no record in these packets")
    return "packets"
  end
  local buffer, place = tvb, parts[1][1]
  if #parts > 1 then buffer, place = ByteArray.new(whole, true):tvb("Record"), 0 end
  return show_record(tree, buffer, place, #whole, #parts > 1 and whole or text)
end

local function is_sure(text, at) return #text - at >= record and (record_size(text, at) or 0) > 0 end

function family.sign(text)
  if is_sure(text, 0) then return true end
  return #text > network and text:byte(1) == 5 and is_network(text, 0) and is_sure(text, network)
end

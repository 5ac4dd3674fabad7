-- Protobuf by tables whose rows have the number of the field as `offset`. Unknown fields are passed over.
local kinds = {varint = 0, ["packed varint"] = 2, f32 = 5, string = 2, strings = 2, bytes = 2}

-- Low and high 32 bits of a number of ten bytes at most, and where it ends; nil if it is none.
local function varint(text, at, stop)
  local low, high = 0, 0
  for i = 0, 9 do
    if at >= stop then return nil end
    local byte = text:byte(at + 1)
    at = at + 1
    local value = byte % 128
    if i < 4 then
      low = low + value * 2 ^ (7 * i)
    elseif i == 4 then
      low = low + value % 16 * 2 ^ 28
      high = math.floor(value / 16)
    else
      high = (high + value * 2 ^ (7 * i - 32)) % 2 ^ 32
    end
    if byte < 128 then return low, high, at end
  end
end

-- Calls each(number, kind, from, to, low, high) for every field between `at` and `stop`; the place of its value.
-- False if the bytes are no protobuf.
function sonar.each_field(text, at, stop, each)
  while at < stop do
    local key, _, from = varint(text, at, stop)
    if not key or key < 8 then return false end
    local kind, to, low, high = key % 8, nil, nil, nil
    if kind == 0 then
      low, high, to = varint(text, from, stop)
    elseif kind == 2 then
      local size, more, value = varint(text, from, stop)
      if size and more == 0 then from, to = value, value + size end
    elseif kind == 1 or kind == 5 then
      to = from + (kind == 1 and 8 or 4)
    end
    if not to or to > stop then return false end
    each(math.floor(key / 8), kind, from, to, low, high)
    at = to
  end
  return true
end

local function range_of(tvb, from, to) return tvb(from, to - from) end

local function show_packed(tree, row, tvb, text, from, to)
  local item = tree:add(row.field, range_of(tvb, from, to), varint(text, from, to) or 0)
  local count, at = 0, from
  while at < to do
    local low, _, after = varint(text, at, to)
    if not low then return sonar.fault(item, "a number is cut") end
    if count > 0 and count < sonar.proto.prefs.elements then tree:add(row.field, tvb(at, after - at), low) end
    count, at = count + 1, after
  end
  item:append_text((" (first of %d)"):format(count))
end

local function show_value(family, tree, row, tvb, text, from, to, low, high, parts)
  local range = to > from and range_of(tvb, from, to) or nil
  if parts[row.name] and range then
    parts[row.name](tree, tvb, text, from, to)
  elseif row.type == "varint" then
    tree:add(row.field, range, UInt64.new(low, high)):append_text(row.unit and " " .. row.unit or "")
  elseif row.type == "f32" then
    tree:add_le(row.field, range):append_text(row.unit and " " .. row.unit or "")
  elseif not range then
    return
  elseif row.type == "packed varint" then
    show_packed(tree, row, tvb, text, from, to)
  elseif row.type == "bytes" then
    tree:add(row.field, range):append_text((" [%d]"):format(to - from))
  elseif family.tables[row.type] then
    local item = tree:add(row.field, range)
    sonar.show_protobuf(family, item, family.tables[row.type], tvb, text, from, to, parts)
  else
    tree:add(row.field, range, sonar.printable(text:sub(from + 1, to)))
  end
end

-- Shows the fields of a message. parts[name](tree, tvb, text, from, to) shows a field of that name in place of its
-- bytes.
function sonar.show_protobuf(family, tree, tab, tvb, text, at, stop, parts)
  local rows = {}
  for _, row in ipairs(tab.rows) do rows[row.offset] = row end
  local good = sonar.each_field(text, at, stop, function(number, kind, from, to, low, high)
    local row = rows[number]
    local wanted = row and (family.tables[row.type] and 2 or kinds[row.type])
    if wanted == kind then show_value(family, tree, row, tvb, text, from, to, low, high, parts or {}) end
  end)
  return good or sonar.fault(tree, "no protobuf from here on")
end

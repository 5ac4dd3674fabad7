-- Walks a table of rows over bytes and shows each as a field. Never reads beyond `stop`: what is not there is
-- shown as a fault.
sonar.proto = Proto("sonar", "Sonar protocols of echoloop")
sonar.fault_expert = ProtoExpert.new("sonar.fault", "not as the protocol has it", expert.group.PROTOCOL, expert.severity.WARN)
sonar.proto.experts = {sonar.fault_expert}
sonar.proto.prefs.elements = Pref.uint("Elements shown of an array", 64, "Of longer arrays the rest is shown as bytes only")

function sonar.fault(tree, text) tree:add_proto_expert_info(sonar.fault_expert, text) return false end

-- A place in bytes: `tables` are the family's.
function sonar.reader(family, tvb, at, stop)
  return {tables = family.tables, tvb = tvb, at = at, stop = stop, size = stop - at, counts = {}}
end

-- The next `size` bytes, which may not be none; nil if they are not there.
local function take(r, size)
  if size <= 0 or size > r.stop - r.at then return nil end
  local range = r.tvb(r.at, size)
  r.at = r.at + size
  return range
end

local function short(r, tree, row)
  return sonar.fault(tree, row.name .. ": the bytes end here")
end

-- Characters up to a NUL; others than printable ASCII as \xNN.
function sonar.printable(text)
  text = text:match("^[^%z]*")
  return (text:gsub("[^\32-\126]", function(c) return ("\\x%02x"):format(c:byte()) end))
end

function sonar.add_unit(item, row)
  if row.unit then item:append_text((row.unit:match("^%d") and " x " or " ") .. row.unit) end
  return item
end

local function add_value(tree, tab, row, range)
  if sonar.is_text(row) then return tree:add(row.field, range, sonar.printable(range:raw())) end
  if row.type == "hex[4]" then return tree:add(row.field, range, tonumber(range:string(), 16) or 0) end
  local item = tab.big and tree:add(row.field, range) or tree:add_le(row.field, range)
  for _, flag in ipairs(row.flags or {}) do
    if tab.big then item:add(flag, range) else item:add_le(flag, range) end
  end
  return sonar.add_unit(item, row)
end

local function number_of(tab, range)
  if range:len() == 8 then return (tab.big and range:uint64() or range:le_uint64()):tonumber() end
  return tab.big and range:uint() or range:le_uint()
end

local function add_elements(r, tree, tab, row, count, size)
  local whole = take(r, count * size)
  if not whole then return count == 0 or short(r, tree, row) end
  if row.words then return true, tree:add(row.words, whole, sonar.printable(whole:raw())) end
  local item = tree:add(row.block, whole)
  item:append_text(" [" .. count .. "]")
  if not row.field then return true end
  for i = 0, math.min(count, sonar.proto.prefs.elements) - 1 do
    add_value(item, tab, row, whole(i * size, size)):prepend_text("[" .. i .. "] ")
  end
  return true
end

local function add_struct(r, tree, row, tab)
  local from = r.at
  local item = tree:add(row.field, r.tvb(from, math.max(r.stop - from, 0)))
  local good = sonar.walk(r, tab, item)
  item:set_len(r.at - from)
  return good, item
end

-- What is behind the structs that are shown is passed over.
local function add_structs(r, tree, row, count)
  local tab = r.tables[row.type]
  local size = sonar.fixed_size(r.tables, tab)
  if count * size > r.stop - r.at then return short(r, tree, row) end
  if count == 0 then return true end
  local all = tree:add(row.field, r.tvb(r.at, count * size))
  all:append_text(" [" .. count .. "]")
  local stop = r.at + count * size
  for i = 0, math.min(count, sonar.proto.prefs.elements) - 1 do
    local good, item = add_struct(r, all, row, tab)
    item:append_text("[" .. i .. "]")
    if not good then return false end
  end
  r.at = stop
  return true
end

-- Bytes of a table of which the content does not decide the size; nil if it does.
function sonar.fixed_size(tables, tab)
  local sum = 0
  for _, row in ipairs(tab.rows) do
    if row.kind == "counted" or row.kind == "rest" or row.kind == "list" then return nil end
    local one = row.kind == "group" and sonar.fixed_size(tables, tables[row.type]) or sonar.size_of(row)
    if not one then return nil end
    sum = sum + one * (row.elements or 1)
  end
  return sum
end

local function elements_of(r, row)
  local one, two = r.counts[row.count], row.times and r.counts[row.times] or 1
  return one and two and math.ceil(one * two / (row.per or 1))
end

local kinds = {}

function kinds.value(r, tree, tab, row)
  if row.elements and not sonar.is_text(row) then
    return add_elements(r, tree, tab, row, row.elements, sonar.size_of(row))
  end
  local range = take(r, sonar.size_of(row))
  if not range then return short(r, tree, row) end
  return true, add_value(tree, tab, row, range), range
end

-- `special` of the reader: structs that are read as one number, by the names of their tables.
function kinds.group(r, tree, _, row)
  if r.special and r.special[row.type] then return r.special[row.type](r, tree, row) end
  return (add_struct(r, tree, row, r.tables[row.type]))
end

function kinds.count(r, tree, tab, row)
  if r.tables[row.type] then return kinds.group(r, tree, tab, row) end
  local good, item, range = kinds.value(r, tree, tab, row)
  if not good then return false end
  local raw = row.type == "hex[4]" and tonumber(range:string(), 16) or row.type ~= "hex[4]" and number_of(tab, range)
  local count = raw and raw - (row.bias or 0)
  if not count or count < 0 then return sonar.fault(item, "no such count") end
  if tab.counted_here[row.key] and r.counts[row.key] ~= count then return sonar.fault(item, "two counts differ") end
  tab.counted_here[row.key] = true
  r.counts[row.key] = count
  return true
end

function kinds.counted(r, tree, tab, row)
  local count = elements_of(r, row)
  if not count then return sonar.fault(tree, row.name .. ": its count is not there") end
  if row.tables then return add_structs(r, tree, row, count) end
  return add_elements(r, tree, tab, row, count, sonar.size_of(row))
end

function kinds.constant(r, tree, tab, row)
  local good, item, range = kinds.value(r, tree, tab, row)
  if good and number_of(tab, range) ~= (row.constant or 0) then return sonar.fault(item, "not the constant that stands here") end
  return good
end

function kinds.magic(r, tree, tab, row)
  local good, item, range = kinds.value(r, tree, tab, row)
  if good and range:raw() ~= row.characters then return sonar.fault(item, "not " .. row.characters) end
  return good
end

function kinds.total_size(r, tree, tab, row)
  local good, item, range = kinds.value(r, tree, tab, row)
  local said = good and number_of(tab, range)
  if good and said ~= r.size and said ~= 0 then return sonar.fault(item, "there are " .. r.size .. " bytes") end
  return good
end

function kinds.rest(r, tree, tab, row)
  return (add_elements(r, tree, tab, row, r.stop - r.at, 1))
end

function kinds.list(r, tree, _, row)
  local size = sonar.fixed_size(r.tables, r.tables[row.type])
  local left = r.stop - r.at
  if not add_structs(r, tree, row, math.floor(left / size)) then return false end
  return left % size == 0 or short(r, tree, row)
end

-- The family says how its sections are cut.
function kinds.section(r, tree, _, row) return r.section(r, tree, row) end
kinds.tagged_list = kinds.section

-- Shows all rows; false from the first that is not there or is wrong.
function sonar.walk(r, tab, tree)
  tab.counted_here = {}
  for _, row in ipairs(tab.rows) do
    if not kinds[row.kind](r, tree, tab, row) then return false end
  end
  return true
end

-- A message that is all the bytes up to `stop`.
function sonar.show(family, tree, name, tvb, at, stop)
  local r = sonar.reader(family, tvb, at, stop)
  if sonar.walk(r, family.tables[name], tree) and r.at < stop then
    sonar.fault(tree, (stop - r.at) .. " bytes more than " .. name .. " has")
  end
  return name
end

-- A word of text as the row has it, or, without one, as `other_field`.
function sonar.show_word(tree, row, range, value, other_field)
  local number = row and row.type == "number" and tonumber((value:gsub("^%s*%+?", "")))
  if number then
    sonar.add_unit(tree:add(row.field, range, number), row)
  elseif row and row.type ~= "number" then
    tree:add(row.field, range, value)
  else
    tree:add(other_field, range, value)
  end
end

-- Words between commas, which begin at byte `from`.
function sonar.show_list(tree, tvb, from, text, tab, other_field)
  local place, at = 0, 1
  while at <= #text + 1 do
    local value = text:match("^[^,]*", at)
    place = place + 1
    local word = value:match("^%s*(.*)$")
    if word ~= "" then
      local range = tvb(from + at - 1 + #value - #word, #word)
      sonar.show_word(tree, tab and tab.rows[place], range, word, other_field)
    end
    at = at + #value + 1
  end
end

-- Lines '$' or '!' to CR LF; known sentences by their tables, others field by field.
local family = sonar.families.nmea
local T = family.tables
local longest = 1024
local address_field = sonar.text_field("sonar.nmea.address", "address", "talker and formatter")
local other_field = sonar.text_field("sonar.nmea.field", "field", "of a sentence without a table")
local sum_field = ProtoField.uint8("sonar.nmea.checksum", "checksum", base.HEX, nil, 0, "exclusive or of the characters")
for _, field in ipairs({address_field, other_field, sum_field}) do table.insert(family.fields, field) end

family.mark = "[$!]"

function family.frame(text, at)
  if not text:match("^[$!]", at + 1) then return 0 end
  local line, stop = text:match('^([$!][ "#&-~%%]*)\r?\n()', at + 1)
  if line then return line:match("^.[A-Z0-9][A-Z0-9][A-Z0-9]+[,*]?") and #line <= longest and stop - 1 - at or 0 end
  if text:match('^[$!][ "#&-~%%]*\r?$', at + 1) and #text - at <= longest then return nil end
  return 0
end

local function sum_of(body)
  local sum = 0
  for i = 1, #body do sum = bit.bxor(sum, body:byte(i)) end
  return sum
end

local function show_field(tree, row, range, value)
  if row and row.type == "number" and tonumber(value) then
    local item = tree:add(row.field, range, tonumber(value))
    if row.unit then item:append_text(" " .. row.unit) end
  elseif row and row.type ~= "number" then
    tree:add(row.field, range, value)
  elseif not row then
    tree:add(other_field, range, value)
  else
    sonar.fault(tree, row.name .. ": not a number")
  end
end

function family.display(tree, tvb, at, size, text)
  local line = text:sub(at + 1, at + size):match("^[^\r\n]*")
  local body, sum = line:match("^.([^*]*)%*(%x%x)$")
  body = body or line:sub(2)
  local address = body:match("^[^,]*")
  local tab = #address == 5 and T[address:sub(3)]
  tree:add(address_field, tvb(at + 1, #address), address)
  local place, from = 0, #address + 1
  while from <= #body do
    local value = body:match("^[^,]*", from + 1)
    place = place + 1
    if value ~= "" then show_field(tree, tab and tab.rows[place], tvb(at + 1 + from, #value), value) end
    from = from + #value + 1
  end
  if sum then
    local item = tree:add(sum_field, tvb(at + #line - 2, 2), tonumber(sum, 16))
    sonar.check(item, "checksum", tonumber(sum, 16), sum_of(body))
  end
  return tab and tab.name or address
end

function family.sign(text)
  local body, sum = text:match("^[$!]([^*%c]*)%*(%x%x)\r?\n")
  return body ~= nil and tonumber(sum, 16) == sum_of(body)
end

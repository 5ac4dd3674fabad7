-- A Wireshark field for each row of a family's tables: sonar.FAMILY.TABLE.ROW. Reads no bytes.
-- A row's `field` takes its value; `block` the bytes of an array whose elements are `field`; `flags` its bits.
local sizes = {u8 = 1, i8 = 1, u16 = 2, i16 = 2, u32 = 4, i32 = 4, u64 = 8, i64 = 8, f32 = 4, f64 = 8}
local makers = {
  u8 = ProtoField.uint8, u16 = ProtoField.uint16, u32 = ProtoField.uint32, u64 = ProtoField.uint64,
  i8 = ProtoField.int8, i16 = ProtoField.int16, i32 = ProtoField.int32, i64 = ProtoField.int64,
}
local varints = {varint = ProtoField.uint64, ["packed varint"] = ProtoField.uint32}

-- Bytes of one element; nil for structs and texts whose end they tell themselves.
function sonar.size_of(row)
  local characters = row.type and row.type:match("^char%[(%d+)%]$")
  return sizes[row.type] or (characters and tonumber(characters)) or (row.type == "hex[4]" and 4) or nil
end

function sonar.is_text(row) return row.kind == "magic" or row.type:match("^char") ~= nil end

-- Of a kind whose short constructor takes its help in another place in each version of Wireshark.
local function plain_field(abbr, name, ftype, help) return ProtoField.new(name, abbr, ftype, nil, base.NONE, nil, help) end
function sonar.text_field(abbr, name, help) return plain_field(abbr, name, ftypes.STRING, help) end

local function help_of(row)
  local unit = row.unit and (row.unit:match("^%d") and "x " .. row.unit or row.unit)
  if unit and row.help then return unit .. ": " .. row.help end
  return row.help or unit or ""
end

local function names_of(row)
  if not row.names or row.format == "bits" then return nil end
  local out = {}
  for _, pair in ipairs(row.names) do out[pair[1]] = pair[2] end
  return out
end

local function number_field(abbr, row)
  local make = makers[row.type] or varints[row.type]
  if row.type == "f32" then return plain_field(abbr, row.name, ftypes.FLOAT, help_of(row)) end
  if row.type == "f64" then return plain_field(abbr, row.name, ftypes.DOUBLE, help_of(row)) end
  if row.format == "ipv4" then return ProtoField.ipv4(abbr, row.name, help_of(row)) end
  local unsigned = row.type:match("^u") ~= nil  -- Wireshark shows no others in hexadecimal
  local base = unsigned and (row.format == "hex" or row.format == "bits") and base.HEX or base.DEC
  local names = sizes[row.type] and sizes[row.type] < 8 and names_of(row) or nil
  return make(abbr, row.name, base, names, 0, help_of(row))
end

-- For numbers that are no number type of the tables.
function sonar.number_field(row) return ProtoField.uint32(row.abbr, row.name, base.DEC, nil, 0, help_of(row)) end
function sonar.signed_field(row) return ProtoField.int32(row.abbr, row.name, base.DEC, nil, 0, help_of(row)) end

local function value_field(abbr, row)
  if sizes[row.type] or varints[row.type] then return number_field(abbr, row) end
  if row.type == "hex[4]" then return ProtoField.uint16(abbr, row.name, base.DEC, nil, 0, help_of(row)) end
  if row.type == "bytes" then return ProtoField.bytes(abbr, row.name, base.NONE, help_of(row)) end
  if row.type == "number" then return plain_field(abbr, row.name, ftypes.DOUBLE, help_of(row)) end
  return sonar.text_field(abbr, row.name, help_of(row))
end

local function is_struct(family, row) return row.tables ~= nil or family.tables[row.type] ~= nil end

-- Samples stay one block, texts are one, of other arrays the elements are shown too.
local function is_run(row) return row.type == "u8" and (row.kind == "counted" or row.kind == "rest") end
local function is_samples(row) return is_run(row) and row.name ~= "text" end
local function is_run_of_text(row) return is_run(row) and row.name == "text" end
local function is_array(row)
  return row.kind == "counted" or row.kind == "rest" or (row.elements and not sonar.is_text(row))
end

local function make_flags(family, abbr, row)
  row.flags = {}
  for _, bit_name in ipairs(row.names) do
    local name = abbr .. "." .. bit_name[2]:gsub("[^%w_-]", "_")
    local field = ProtoField.bool(name, bit_name[2], 8 * sizes[row.type], nil, bit_name[1])
    table.insert(row.flags, field)
    table.insert(family.fields, field)
  end
end

local function make_fields(family, tab, row)
  local abbr = "sonar." .. family.name .. "." .. tab.name:gsub("[^%w_-]", "_") .. "." .. row.name:gsub("[^%w_-]", "_")
  if is_struct(family, row) then
    row.field = ProtoField.none(abbr, row.name, help_of(row))
  elseif is_run_of_text(row) then
    row.words = sonar.text_field(abbr, row.name, help_of(row))
    table.insert(family.fields, row.words)
    return
  elseif is_samples(row) then
    row.block = ProtoField.bytes(abbr, row.name, base.NONE, help_of(row))
    table.insert(family.fields, row.block)
    return
  else
    row.field = value_field(abbr, row)
    if is_array(row) then
      row.block = ProtoField.bytes(abbr .. ".bytes", row.name, base.NONE, help_of(row))
      table.insert(family.fields, row.block)
    end
    if row.format == "bits" then make_flags(family, abbr, row) end
  end
  row.abbr, row.place = abbr, #family.fields + 1
  table.insert(family.fields, row.field)
end

-- Another field in the place of a row's.
function sonar.replace_field(family, row, field)
  row.field = field
  family.fields[row.place] = field
end

-- The family's protocol with all its fields; its part of this script adds what tells its messages apart.
function sonar.add_family(name, title, places)
  local family = {name = name, title = title, places = places, fields = {}, tables = sonar.tables[name]}
  family.proto = Proto("sonar." .. name, title)
  for _, tab in pairs(family.tables) do
    tab.rows_by_name = {}
    for _, row in ipairs(tab.rows) do
      tab.rows_by_name[row.name] = row
      make_fields(family, tab, row)
    end
  end
  sonar.families[name] = family
  table.insert(sonar.families, family)
end

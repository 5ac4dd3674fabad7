-- One packet a datagram; sections {tag[2], u16 size} in any order, status sections {tag[4], words}.
local family = sonar.families.r2sonic
family.datagram = true
family.mark = "%z"
local with_head = {AID0 = true, WCD0 = true}
local section_header, settings_name = 4, 4
local unknown_field = ProtoField.bytes("sonar.r2sonic.unknown", "unknown", base.NONE, "section without a table")
table.insert(family.fields, unknown_field)

local names = {}
for name in pairs(family.tables) do if name:match("^%u%u%u%d$") or name:match("^R2D%u$") then names[name] = true end end
names.AID0, names.WCD0 = true, true

local function name_of(text)
  local name = text:sub(1, 4)
  if not names[name] then return nil end
  if with_head[name] then return name .. (text:sub(13, 14) == "H0" and " head" or " data") end
  return name
end

function family.frame(text, at) return at == 0 and name_of(text) and #text or 0 end

-- Words that the 4th character of a status section announces.
local function words_of(character)
  local value = tonumber(character, 36)
  return value and value > 0 and value or nil
end

local function status_table(tag)
  for _, tab in pairs(family.tables) do
    if tab.tag and #tab.tag == 4 and tab.tag:sub(1, 3) == tag:sub(1, 3) and tab.tag:lower() == tag:lower() then return tab end
  end
end

-- Shows a section of `size` bytes without its header.
local function show_section(r, tree, tab, tag, size)
  local outer = r.stop
  r.stop = r.at + size
  local item = tree:add(family.proto, r.tvb(r.at - section_header, size + section_header), "Section " .. tag)
  if not tab then
    item:append_text(", unknown")
    if size > 0 then item:add(unknown_field, r.tvb(r.at, size)) end
  elseif sonar.walk(r, tab, item) and r.stop - r.at >= 4 then
    sonar.fault(item, "bytes left over")
  end
  r.at, r.stop = r.stop, outer
end

local function status_sections(r, tree)
  while r.at < r.stop do
    if r.stop - r.at < section_header then return sonar.fault(tree, "a section is cut") end
    local tag = r.tvb(r.at, section_header):raw()
    local words = words_of(tag:sub(4))
    r.at = r.at + section_header
    if not words or words * 4 > r.stop - r.at then return sonar.fault(tree, "a section is cut") end
    show_section(r, tree, status_table(tag), sonar.printable(tag), words * 4)
  end
  return true
end

-- The table of a tag among those that the packet's rows name.
local function section_table(packet, tag)
  for _, row in ipairs(packet.rows) do
    for _, name in ipairs(row.kind == "section" and row.tables or {}) do
      if family.tables[name].tag == tag then return family.tables[name] end
    end
  end
end

local function data_sections(r, tree)
  while r.at < r.stop do
    if r.stop - r.at < section_header then return sonar.fault(tree, "a section is cut") end
    local tag, size = r.tvb(r.at, 2):raw(), r.tvb(r.at + 2, 2):uint()
    if size < section_header or size > r.stop - r.at then return sonar.fault(tree, "a section's size cannot be") end
    r.at = r.at + section_header
    show_section(r, tree, section_table(r.packet, tag), sonar.printable(tag), size - section_header)
  end
  return true
end

-- A setting by its name: some stand for several of which one character differs.
local function setting_row(name)
  local rows = family.tables.Settings.rows_by_name
  local of_port = name:match("^..[GMHS]0$") and name:sub(1, 2) .. "?0"
  local of_mode = name:match("^...[1-4]$") and name:sub(1, 3) .. "0"
  return rows[name] or rows[of_port or ""] or rows[of_mode or ""]
end

-- Settings under their own names, as the type and with the unit that these say.
local function show_settings(tree, tvb, at, stop)
  for place = at + 4, stop - 8, 8 do
    local row = setting_row(tvb(place, settings_name):raw())
    if row then sonar.add_unit(tree:add(row.field, tvb(place + settings_name, 4)), row) end
  end
end

function family.display(tree, tvb, at, size, text)
  local name = name_of(text)
  local packet = family.tables[name]
  local r = sonar.reader(family, tvb, at, at + size)
  r.packet = packet
  function r.section(reader, item, row)
    return (row.kind == "tagged_list" and status_sections or data_sections)(reader, item)
  end
  if sonar.walk(r, packet, tree) and r.at < r.stop then sonar.fault(tree, "bytes left over") end
  if name == "CMD0" then show_settings(tree, tvb, at, at + size) end
  return name
end

function family.sign(text) return name_of(text) ~= nil end

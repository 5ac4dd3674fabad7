-- Serial lines (LINKTYPE_RTAC_SERIAL): which family speaks on a line is found out by its first whole message.
local header, event_at, enough = 12, 8, 8192
local rtac = Dissector.get("rtacser")
local lines, spoken = {}, {}

function sonar.proto.init()
  lines, spoken = {}, {}
  sonar.forget()
end

-- A message of another family than was thought: it is that one's line.
function sonar.take_over(key, family)
  local line = key:match("^line %d+")
  if lines[line] then lines[line] = family end
end

-- The family of the line that `key` is a direction of; nil until it has said a whole message.
local function family_of(key, text)
  local line = key:match("^line %d+")
  if lines[line] then return lines[line] end
  local heard = (spoken[key] or "") .. text
  spoken[key] = heard:sub(-enough)
  for _, family in ipairs(sonar.families) do
    for _, piece in ipairs(family.places.serial and sonar.cut(family, heard, true) or {}) do
      if not piece.noise and (not family.is_sure or family.is_sure(heard, piece[1], piece[2])) then
        lines[line] = family
        spoken[key] = heard:sub(1, -#text - 1)
        for _, one in ipairs({line .. " 0", line .. " 1"}) do sonar.heard_before(one, spoken[one]) end
        return family
      end
    end
  end
end

function sonar.proto.dissector(tvb, pinfo, tree)
  if tvb:len() <= header then return rtac:call(tvb, pinfo, tree) end
  local key = sonar.line(tvb(event_at, 1):uint())
  local family = family_of(key, tvb:raw(header))
  if not family then return rtac:call(tvb, pinfo, tree) end
  rtac:call(tvb(0, header):tvb(), pinfo, tree)
  local bytes = tvb(header):tvb()
  return header + sonar.dissect_in_turn(family, key, bytes, pinfo, tree)
end

for _, family in ipairs(sonar.families) do
  sonar.add_places(family)
  family.proto.fields = family.fields
end
DissectorTable.get("wtap_encap"):add(wtap_encaps.RTAC_SERIAL or 153, sonar.proto)

-- Frames from "BR" to the sum, of the Ping protocol and of Cerulean's sonars.
local payload_at, overhead, longest = 8, 10, 65545

-- The tables of ids, by the names of the header's field.
function sonar.names_by_id(family)
  local out = {}
  for _, pair in ipairs(family.tables.Header.rows_by_name.id.names) do
    out[pair[1]] = family.tables[pair[2]] and pair[2]
  end
  return out
end

local function frame(text, at)
  local start = text:sub(at + 1, at + 2)
  if start ~= ("BR"):sub(1, #start) then return 0 end
  local length = sonar.le(text, at + 2, 2)
  if not length then return nil end
  return length + overhead <= longest and length + overhead or 0
end

local function good(text, at, size)
  return sonar.sum(text:sub(at + 1, at + size - 2)) % 65536 == sonar.le(text, at + size - 2, 2)
end

-- What a family with these frames shows of one.
function sonar.show_ping(of, names, tree, tvb, at, size, text)
  local frame, rows = sonar.tables.ping.Frame.rows_by_name, of.tables.Header
  local id = sonar.le(text, at + 4, 2)
  tree:add_le(frame.payload_length.field, tvb(at + 2, 2))
  sonar.walk(sonar.reader(of, tvb, at + 4, at + payload_at), rows, tree)
  local name, length = names[id], size - overhead
  local tab = name and of.tables[name]
  if tab and length == 0 and #tab.rows > 0 and tab.rows[1].kind ~= "rest" then
    name = name .. " request"
  elseif tab then
    sonar.show(of, tree, name, tvb, at + payload_at, at + size - 2)
  else
    sonar.fault(tree, "no message that is known")
  end
  tree:add_le(frame.checksum.field, tvb(at + size - 2, 2))
  return name or "id " .. id
end

-- Gives a family these frames.
function sonar.use_ping_frames(family)
  family.mark, family.frame, family.good, family.resumes = "B", frame, good, true
end

function sonar.begins_as_ping(text)
  return #text >= overhead and text:sub(1, 2) == "BR" and (frame(text, 0) or 0) > 0
end

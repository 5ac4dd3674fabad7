-- Messages out of runs of bytes: TCP by Wireshark's own reassembly, serial lines and datagrams by keeping what
-- waits for the rest, by direction. A family has:
--   frame(text, at)         bytes of the message at `at` (from 0), maybe more than there are; 0: none; nil: not to be
--                           told yet
--   good(text, at, size)    whether a whole one is one; optional
--   display(tree, tvb, at, size, text)   shows it and returns its name
--   mark                    a pattern of the characters that messages begin with
--   resumes                 a whole message within one that is cut is no content of that one; optional
--   other(text, at, size)   another family whose message it is; optional
local most_waiting = 0x110000
local streams, shown = {}, {}

function sonar.forget() streams, shown = {}, {} end

local function is_whole(family, text, at)
  local size = family.frame(text, at)
  if not size or size == 0 or size > #text - at then return nil, size end
  if family.good and not family.good(text, at, size) then return nil, 0 end
  return size, size
end

local function next_mark(family, text, at)
  local found = text:find(family.mark, at + 2)
  return found and found - 1 or #text
end

-- Whether another message stands whole within one that is not there: bytes of the first were lost.
local function whole_behind(family, text, at)
  if not family.resumes then return nil end
  local from = next_mark(family, text, at)
  while from < #text do
    if is_whole(family, text, from) then return from end
    from = next_mark(family, text, from)
  end
end

-- {at, size} of each message, {at, size, noise = true} of what is none; then where a message begins that is not
-- there as a whole, and the bytes that it lacks, if that is known. `last`: nothing more will come.
function sonar.cut(family, text, last)
  local pieces, covered, at = {}, 0, 0
  local function noise_to(stop)
    if stop > covered then table.insert(pieces, {covered, stop - covered, noise = true}) end
  end
  while at < #text do
    local whole, size = is_whole(family, text, at)
    if whole then
      noise_to(at)
      table.insert(pieces, {at, whole})
      at = at + whole
      covered = at
    elseif not last and size ~= 0 and not whole_behind(family, text, at) then
      noise_to(at)
      return pieces, at, size and size - (#text - at)
    else
      at = next_mark(family, text, at)
    end
  end
  noise_to(#text)
  return pieces
end

local function count_messages(pieces)
  local count = 0
  for _, piece in ipairs(pieces) do count = count + (piece.noise and 0 or 1) end
  return count
end

function sonar.show_pieces(family, tvb, text, pieces, pinfo, tree)
  local names = {}
  for _, piece in ipairs(pieces) do
    local at, size = piece[1], piece[2]
    local speaker = not piece.noise and family.other and family.other(text, at, size) or family
    local item = tree:add(speaker.proto, tvb(at, size))
    local name = "noise"
    if piece.noise then
      item:append_text(", " .. size .. " bytes that are no message")
    else
      name = speaker.display(item, tvb, at, size, text)
      item:append_text(", " .. name)
    end
    if #names < 8 then table.insert(names, name) end
  end
  if #names > 0 then
    pinfo.cols.protocol = family.name
    pinfo.cols.info = table.concat(names, ", ")
  end
end

function sonar.dissect_tcp(family, tvb, pinfo, tree)
  local text = tvb:raw()
  local pieces, waits, lacking = sonar.cut(family, text, pinfo.can_desegment == 0)
  sonar.show_pieces(family, tvb, text, pieces, pinfo, tree)
  if waits then
    pinfo.desegment_offset = waits
    pinfo.desegment_len = lacking and lacking > 0 and lacking or DESEGMENT_ONE_MORE_SEGMENT
  end
  return tvb:len()
end

-- What a direction has said before its family was known.
function sonar.heard_before(key, text) streams[key] = text ~= "" and text or nil end

local function keep(family, id, key, tvb)
  local before = streams[key] or ""
  local text = before .. tvb:raw()
  local pieces, waits = sonar.cut(family, text, #text > most_waiting)
  for _, piece in ipairs(pieces) do
    local other = not piece.noise and family.other and family.other(text, piece[1], piece[2])
    if other then sonar.take_over(key, other) end
  end
  streams[key] = waits and text:sub(waits + 1) or nil
  shown[id] = {text = #pieces > 0 and text:sub(1, waits or #text) or "", before = #before, waits = waits and #text - waits}
end

-- Bytes that come next in one direction, `key`, which may begin or end within a message.
function sonar.dissect_in_turn(family, key, tvb, pinfo, tree)
  local id = pinfo.number .. " " .. key
  if not pinfo.visited and not shown[id] then keep(family, id, key, tvb) end
  local one = shown[id]
  if not one then return 0 end
  if one.text ~= "" then
    local buffer = one.before > 0 and ByteArray.new(one.text, true):tvb("Reassembled") or tvb
    sonar.show_pieces(family, buffer, one.text, sonar.cut(family, one.text, true), pinfo, tree)
  end
  if one.waits then
    local own = math.min(one.waits, tvb:len())
    local item = tree:add(family.proto, tvb(tvb:len() - own, own))
    item:append_text(", " .. own .. " bytes of a message that goes on in a later packet")
    if one.text == "" then
      pinfo.cols.protocol = family.name
      pinfo.cols.info = "part of a message"
    end
  end
  return tvb:len()
end

-- A datagram is read alone where that tells all of it; what is left of others goes on in the next one of the
-- same direction.
function sonar.dissect_udp(family, tvb, pinfo, tree)
  local text = tvb:raw()
  local key = ("%s:%s>%s:%s"):format(pinfo.src, pinfo.src_port, pinfo.dst, pinfo.dst_port)
  local pieces = sonar.cut(family, text, true)
  local whole = #pieces > 0 and count_messages(pieces) == #pieces
  if whole or family.datagram then
    if count_messages(pieces) == 0 then return 0 end
    streams[key] = nil
    sonar.show_pieces(family, tvb, text, pieces, pinfo, tree)
    return tvb:len()
  end
  if not streams[key] and not shown[pinfo.number .. " " .. key] and not family.sign(text) then return 0 end
  return sonar.dissect_in_turn(family, key, tvb, pinfo, tree)
end

local tcp = 2

-- Of a family that can frame and display.
function sonar.dissector_of(family)
  return function(tvb, pinfo, tree)
    if tvb:len() == 0 then return 0 end
    if pinfo.port_type == tcp then return sonar.dissect_tcp(family, tvb, pinfo, tree) end
    if pinfo.port_type ~= 0 then return sonar.dissect_udp(family, tvb, pinfo, tree) end
    return sonar.dissect_in_turn(family, sonar.line(), tvb, pinfo, tree)
  end
end

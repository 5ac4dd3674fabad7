-- Where each family is met: default ports, which the preferences change; serial lines; any port by a sure sign.
-- sign(text): whether the first bytes of a datagram or a connection are surely the family's.
local interface, event = Field.new("frame.interface_id"), Field.new("rtacser.eventtype")

-- The serial line and direction of the packet that is being dissected. `kind`: its event, 1 and 3 are sent.
function sonar.line(kind)
  local number, said = interface(), event()
  kind = kind or (said and said.value) or 0
  return ("line %s %s"):format(number and number.value or 0, kind % 2)
end

local function follow(family, transport, title)
  local proto, port_table = family.proto, DissectorTable.get(transport .. ".port")
  local now = ""
  return function()
    if now ~= "" then port_table:remove(now, proto) end
    now = tostring(proto.prefs[transport] or "")
    if now ~= "" then port_table:add(now, proto) end
  end
end

-- family.places: {tcp = "52100", udp = "52102", serial = true}; serial: it may be met on a serial line.
function sonar.add_places(family)
  local proto, places = family.proto, family.places
  family.dissect = family.dissect or sonar.dissector_of(family)
  proto.dissector = family.dissect
  proto.prefs.tcp = Pref.range("TCP ports", places.tcp or "", "Ports of this protocol, e.g. 7000-7001", 65535)
  proto.prefs.udp = Pref.range("UDP ports", places.udp or "", "Ports of this protocol, e.g. 65400-65410", 65535)
  proto.prefs.anywhere = Pref.bool("Any port", true, "Recognise the protocol by its first bytes on other ports, too")
  local follow_tcp, follow_udp = follow(family, "tcp"), follow(family, "udp")
  local function follow_both()
    follow_tcp()
    follow_udp()
  end
  proto.prefs_changed = follow_both
  follow_both()
  for _, transport in ipairs({"tcp", "udp"}) do
    DissectorTable.get(transport .. ".port"):add_for_decode_as(proto)
    proto:register_heuristic(transport, function(tvb, pinfo, tree)
      if not proto.prefs.anywhere or tvb:len() == 0 or not family.sign(tvb:raw()) then return false end
      if family.dissect(tvb, pinfo, tree) == 0 then return false end
      pinfo.conversation = proto
      return true
    end)
  end
  if places.serial then DissectorTable.get("rtacser.data"):add_for_decode_as(proto) end
end

/** The scene that a new text begins with: small, and something to see. */
export const STARTER = `-- A ball on a floor. Drag a number, click a colour, or type: the picture follows.
ball = sphere {
  radius = 1.0,
  center = (0, 1, 0),
  material = classic { color = #d9532c, reflection = 0.2, shine = 60 },
}

ground = plane { material = classic { color = tiles } }

tiles h = if even (floor h.p.x + floor h.p.z) then #e9e4d8 else #8a9aa3

scene = {
  size = (640, 480),
  camera = perspective { from = (3, 2.5, 6), to = (0, 0.8, 0), fov = 38deg },
  background = \\d -> mix #f3ead9 #7fb0d8 (max 0 d.y),
  lights = [
    point { position = (4, 6, 3), intensity = 0.9 },
    ambient { intensity = 0.15 },
  ],
  objects = [ground, ball],
}
`;

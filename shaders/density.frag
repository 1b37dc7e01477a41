#version 330 core
// A picture of one pixel a cell, stretched to the cells' size. Premultiplied.
uniform sampler2D picture;
uniform float cell;  // side of a cell, pixels
out vec4 color;

void main() { color = texture(picture, gl_FragCoord.xy / (cell * vec2(textureSize(picture, 0)))); }

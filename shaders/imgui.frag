#version 330 core
uniform sampler2D image;
in vec2 image_coordinate;
in vec4 tint;
out vec4 color;

void main() { color = tint * texture(image, image_coordinate); }

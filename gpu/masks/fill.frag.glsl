#version 450 core
// For the check of the driver: one mask everywhere.

layout(location = 0) uniform uvec4 mask;
layout(location = 0) out uvec4 result;

void main() { result = mask; }

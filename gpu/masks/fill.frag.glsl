#version 450 core
// For the self-test: one mask everywhere.

layout(location = 0) uniform uvec4 mask;
layout(location = 0) out uvec4 result;

void main() { result = mask; }

// lut/random.h: the same numbers. 64-bit integers are (low, high).

uvec2 shift_right(uvec2 x, int count) { return uvec2((x.x >> count) | (x.y << (32 - count)), x.y >> count); }

uvec2 add(uvec2 a, uvec2 b) {
  uint carry;
  uint low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}

uvec2 multiply(uvec2 a, uvec2 b) {
  uint high, low;
  umulExtended(a.x, b.x, high, low);
  return uvec2(low, high + a.x * b.y + a.y * b.x);
}

uvec2 mix_bits(uvec2 x) {
  x = multiply(x ^ shift_right(x, 30), uvec2(0x1ce4e5b9u, 0xbf58476du));
  x = multiply(x ^ shift_right(x, 27), uvec2(0x133111ebu, 0x94d049bbu));
  return x ^ shift_right(x, 31);
}

// RandomStream::next_double.
double next_double(inout uvec2 state) {
  state = add(state, uvec2(0x7f4a7c15u, 0x9e3779b9u));
  uvec2 bits = shift_right(mix_bits(state), 11);
  return (double(bits.y) * 4294967296.0lf + double(bits.x)) * 1.1102230246251565404236316680908203125e-16lf;
}

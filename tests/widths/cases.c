/* Expressions whose value depends on the widths and signedness of the source platform: int and long 32 bits, char unsigned.
 * Every function case_x() returns what the expression is worth there. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <stdio.h>
#include <ctype.h>
#define K 1000
#define AREA (K * 50)
#define TICKS(t) ((t) * 80)
enum { BIG = 40000, SMALL = 3 };
enum below { UNDER = -5, OVER = 30000 };
typedef unsigned char byte_t;
struct reading { unsigned value : 12; unsigned flag : 4; short raw; char id; };
unsigned char hi = 0x90, lo = 1, data[4] = { 0x90, 0x10, 0xFF, 0x7F };
short a = 300, b = 200, minus = -2;
unsigned short port = 40000, full = 0xFFFF;
int total = 70000;
enum below under = UNDER;
char ch = 200, text[8] = "70000";
struct reading rd = { 0xFFF, 9, -5, 65 };
short twice(short v) { return v * 2; }
char last(char *s) { return s[0] ? s[strlen(s) - 1] : 0; }

int case_bytes_to_word(void) { return (hi << 8) | lo; }
int case_three_bytes(void) { return data[0] << 16 | data[1] << 8 | data[2]; }
int case_short_product(void) { return a * b; }
long case_short_product_long(void) { return a * b; }
int case_byte_product(void) { return hi * data[2] * 2; }
int case_not_hex(void) { return ~0xFFFF; }
unsigned case_not_zero(void) { return ~0u; }
int case_byte_shift_12(void) { return data[1] << 12; }
int case_one_shift_20(void) { return 1 << 20; }
int case_one_shift_15(void) { return 1 << 15; }
int case_mask_pins(void) { int pin = 26; return 1 << pin | 1 << 4; }
int case_atoi(void) { return atoi(text); }
int case_abs(void) { return abs(-total); }
int case_literal_product(void) { return 300 * 200; }
int case_literal_sum(void) { return 32767 + 1; }
int case_macro_product(void) { return K * K; }
int case_macro_body(void) { return AREA; }
int case_macro_function(void) { return TICKS(a) * 10; }
int case_enum_sum(void) { return BIG + 30000; }
int case_enum_shift(void) { return SMALL << 14; }
int case_sizeof_product(void) { return sizeof(int) * 20000; }
int case_strlen_product(void) { return strlen(text) * 20000; }
int case_signed_vs_sizeof(void) { int n = -1; return n < sizeof(int); }
int case_divide_by_unsigned(void) { int n = -10; return n / 5u; }
int case_ushort_minus(void) { return port - full; }
int case_ushort_equals_minus_one(void) { return full == -1; }
int case_ushort_compare_short(void) { return port > minus; }
int case_ushort_divided(void) { return port / minus; }
int case_ushort_remainder(void) { return port % minus; }
int case_hex_compare(void) { int n = -1; return n < 0x8000; }
int case_hex_literal_sum(void) { return 0x7FFF + 0x10; }
int case_hex_minus(void) { return -0x8000; }
int case_char_sum(void) { return ch + 100; }
int case_char_compare(void) { return ch != -1; }
int case_char_greater(void) { return ch > 127; }
int case_char_shift(void) { return ch << 8; }
int case_char_right_shift(void) { return ch >> 4; }
int case_char_index(void) { static int t[256]; t[200] = 77; return t[ch]; }
int case_char_to_int(void) { int n = ch; return n; }
int case_char_escape(void) { return '\xC8' + 1; }
int case_char_returned(void) { char s[3] = { 65, 66, 0 }; s[1] = 200; return last(s) + 1; }
int case_char_switch(void) { switch (ch) { case 200: return 1; default: return 2; } }
int case_char_member(void) { rd.id = 200; return rd.id * 256; }
int case_string_still_works(void) { char *s = "abc", buf[8]; strcpy(buf, s); strcat(buf, "de"); return strlen(buf) * 20000; }
int case_not_of_byte(void) { return ~hi >> 4; }
int case_minus_of_ushort(void) { return -port; }
int case_comparison_shifted(void) { return (a > b) << 20; }
int case_logical_sum(void) { return (a && b) * 70000; }
int case_conditional(void) { int c = a > b; return c ? minus : port; }
int case_conditional_product(void) { return (a > b ? a : b) * 200; }
int case_compound_shift(void) { short s = 1; s <<= 18; return s; }
int case_compound_divide(void) { unsigned short u = 40000; u /= minus; return u; }
int case_compound_multiply_int(void) { int n = 1000; n *= 1000; return n; }
int case_compound_add_product(void) { int n = 1; n += a * b; return n; }
int case_increment(void) { unsigned short u = 65535; int n = u++ + 1; return n; }
int case_bitfield_shift(void) { return rd.value << 8; }
int case_bitfield_product(void) { return rd.flag * 10000; }
int case_returned_short(void) { return twice(15000) * 3; }
int case_argument(void) { return labs(a * b); }
int case_array_sum(void) { int i, n = 0; for (i = 0; i < 4; i++) n += data[i] * 300; return n; }
int case_pointer_difference(void) { short t[100]; return (&t[90] - &t[0]) * 1000; }
int case_toupper_shift(void) { return toupper('a') << 10; }
int case_average(void) { return (a * 100 + b * 100) / 2; }
int case_float_of_product(void) { float f = a * b; return (int)(f / 10); }
int case_comma_and_parens(void) { int n; return (n = 5, (a) * (b)) + n; }
unsigned case_unsigned_wrap(void) { unsigned n = 0; return n - 1; }
int case_hex_mask(void) { int n = -5; return n & 0xFFFF; }
int case_byte_array_checksum(void) { int i; unsigned sum = 0; for (i = 0; i < 4; i++) sum = (sum << 5) + sum + data[i]; return sum; }
int case_nested(void) { return ((hi << 4 | lo) + (a * b)) * 3 - (b << 8); }
int case_choice_of_two_enumerations(void) { return total ? under : BIG; }
int case_sum_of_long_and_int(void) { long n = 100000; return n + a * b; }

int main(void) {}

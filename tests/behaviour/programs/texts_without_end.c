#include <stdio.h>
#define ID "ABCD"
#define N 3
struct s { char n[4];
  int v;
  char t[2][3]; };
typedef char key[3];
key ks[2] = { "abc", "de" };
struct s a = { "wxyz", 40000, { "abc", "d" } }, b = { .v = 2, .n = "q'\"" }, c = { .n = "1234", .v = 70000 };
char hex[4] = "\x41\102é";
char m[2][N] = { [0] = "fgh", [1] = "ij" };
int main() { char loc[4] = "ab" "cd";
  printf("%.3s %.3s %.4s %d %.3s\n", ks[0], ks[1], a.n, a.v, a.t[0]);
  printf("%.4s %d %.4s %d\n", b.n, b.v, c.n, c.v);
  printf("%.2s %.4s %.3s %.3s\n", hex, loc, m[0], m[1]);
  return 0; }

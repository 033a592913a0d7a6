/* Dice that show each of their numbers and no other. */
#include "simpletools.h"

int main() {
  int seen[10], others = 0, shown = 0;
  for (int n = 0; n < 10; n++) seen[n] = 0;
  for (int n = 0; n < 200; n++) {
    int number = n % 2 ? random(2, 7) : random(7, 2);
    if (number < 2 || number > 7) others++;
    else seen[number]++;
  }
  for (int n = 0; n < 10; n++)
    if (seen[n] > 5) shown++;
  print("%d %d %d\n", shown, others, random(-40000, -40000));
  int large = 0;
  for (int n = 0; n < 50; n++)
    if (random(0, 30000) > 15000) large++;
  print("%d\n", large);
}

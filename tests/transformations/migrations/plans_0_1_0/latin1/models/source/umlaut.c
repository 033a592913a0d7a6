#include "simpletools.h"

// Geschwindigkeit für den Motor: ±5 µs, Größe in °C
int main()
{
  int n = 1;  /* Zähler */
  print("Übertragung läuft: %d\n", n);
  while (1) {
    pause(n);  // Ende der Übung
  }
}

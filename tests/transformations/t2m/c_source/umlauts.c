#include "größenwahn.h"
#define MASS "Länge in µm"
#define größe 3
#define fläche(länge) ((länge) * größe)
struct fühler { int wert; };
typedef struct fühler fühler_t;
enum zustände { AUS, AN };
fühler_t f;
void häufig(int n) { high(n); }
int main() { enum zustände z = AUS; häufig(fläche(2)); größe_t g; f.wert = ungültig; print("%d µs", z); print(MASS); müll(3); }

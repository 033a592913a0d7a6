#define WARM "20 °C" /* Wärme */
int main() { print(WARM); }

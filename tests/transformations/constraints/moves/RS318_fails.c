char bytes[6];
int x;
char full = 255;  // RS318

int main(void)
{
  x = (short)((bytes[1] << 8) + bytes[0]);  // RS318
}

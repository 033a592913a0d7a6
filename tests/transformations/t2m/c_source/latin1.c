// 20 °C
int main()
{
  print("°C");
  high(3);
}

set encoding utf8
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xrange [0.29999999999999999:3]
set yrange [0.0001:10]
set title 'recommend, promised and met - 150 pairs of an unseen scene and an error, seed 20261129' font ",15" noenhanced offset 0,0.3
set xlabel 'predicted over measured time of the run (between the lines: within 15 %)' font ",14" noenhanced
set ylabel 'actual error over the requested error (below the line: met)' font ",14" noenhanced offset -0.5,0
set tics out nomirror
set border 3 linewidth 1.2 linecolor rgb "#404040"
set mxtics 10
set mytics 10
set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb "#e4e4e4"
set key outside right top vertical Left reverse noenhanced samplen 2.2 spacing 1.25 font ",12"
set datafile separator whitespace
set terminal pngcairo size 1400,900 font "DejaVu Sans,12" background rgb "white"
set output './audit.png'
plot './audit.dat' index 0 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './audit.dat' index 1 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './audit.dat' index 2 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './audit.dat' index 3 using 1:2 with points linecolor rgb "#00d62728" pointtype 7 pointsize 1.3 title 'blanes-moan-4', \
     './audit.dat' index 4 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 1.3 title 'dormand-prince-54', \
     './audit.dat' index 5 using 1:2 with points linecolor rgb "#002ca02c" pointtype 7 pointsize 1.3 title 'rk4', \
     './audit.dat' index 6 using 1:2 with points linecolor rgb "#0017becf" pointtype 7 pointsize 1.3 title 'symplectic-euler', \
     './audit.dat' index 7 using 1:2 with points linecolor rgb "#009467bd" pointtype 7 pointsize 1.3 title 'verlet'
unset output
set terminal svg size 1400,900 font "DejaVu Sans,12" background rgb "white" enhanced
set output './audit.svg'
plot './audit.dat' index 0 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './audit.dat' index 1 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './audit.dat' index 2 using 1:2 with lines linecolor rgb "#00606060" linewidth 1.5 dashtype "-" notitle, \
     './audit.dat' index 3 using 1:2 with points linecolor rgb "#00d62728" pointtype 7 pointsize 1.3 title 'blanes-moan-4', \
     './audit.dat' index 4 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 1.3 title 'dormand-prince-54', \
     './audit.dat' index 5 using 1:2 with points linecolor rgb "#002ca02c" pointtype 7 pointsize 1.3 title 'rk4', \
     './audit.dat' index 6 using 1:2 with points linecolor rgb "#0017becf" pointtype 7 pointsize 1.3 title 'symplectic-euler', \
     './audit.dat' index 7 using 1:2 with points linecolor rgb "#009467bd" pointtype 7 pointsize 1.3 title 'verlet'
unset output

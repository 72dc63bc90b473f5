set encoding utf8
set datafile separator whitespace
set tics out nomirror font ",11"
set border 3 linewidth 1.2 linecolor rgb "#404040"
set xlabel font ",12"
set ylabel font ",12"
set palette defined (0 "#2166ac", 0.25 "#92c5de", 0.5 "#f7f7f7", 0.75 "#f4a582", 1 "#b2182b")
set cbrange [-1:1]
set cblabel "" noenhanced font ",12"
unset colorbox
set terminal pngcairo size 2000,1100 font "DejaVu Sans,12" background rgb "white"
set output "amplification.png"
set multiplot layout 2,3 rowsfirst margins 0.055,0.985,0.075,0.9 spacing 0.055,0.13 title "One step of an undamped oscillation: lines are closed forms, points are measured" noenhanced font ",17"
set title "implicit: amplitude" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:1000]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [0:1.05]
set ylabel "amplitude after a step" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 0 using 1:2 with lines linecolor rgb "#007f7f7f" linewidth 1.6 notitle, \
     "amplification.dat" index 1 using 1:2 with points linecolor rgb "#007f7f7f" pointtype 5 pointsize 0.8 notitle, \
     "amplification.dat" index 2 using 1:2 with lines linecolor rgb "#009467bd" linewidth 1.6 notitle, \
     "amplification.dat" index 3 using 1:2 with points linecolor rgb "#009467bd" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 4 using 1:2 with lines linecolor rgb "#00ff7f0e" linewidth 1.6 notitle, \
     "amplification.dat" index 5 using 1:2 with points linecolor rgb "#00ff7f0e" pointtype 7 pointsize 0.8 notitle, \
     "amplification.dat" index 6 using 1:2 with lines linecolor rgb "#005a5aa8" linewidth 1.6 notitle, \
     "amplification.dat" index 7 using 1:2 with points linecolor rgb "#005a5aa8" pointtype 11 pointsize 0.8 notitle
set title "implicit: phase error" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:1000]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [9.9999999999999995e-07:2]
set ylabel "|phase / (h omega) - 1|" noenhanced
set xtics autofreq
set ytics autofreq
set key bottom right Left reverse noenhanced samplen 1.5 font ",11"
plot "amplification.dat" index 8 using 1:2 with lines linecolor rgb "#007f7f7f" linewidth 1.6 notitle, \
     "amplification.dat" index 9 using 1:2 with points linecolor rgb "#007f7f7f" pointtype 5 pointsize 0.8 title "backward-euler, baraff-witkin, local-global", \
     "amplification.dat" index 10 using 1:2 with lines linecolor rgb "#009467bd" linewidth 1.6 notitle, \
     "amplification.dat" index 11 using 1:2 with points linecolor rgb "#009467bd" pointtype 9 pointsize 0.8 title "ros2, sdirk2", \
     "amplification.dat" index 12 using 1:2 with lines linecolor rgb "#00ff7f0e" linewidth 1.6 notitle, \
     "amplification.dat" index 13 using 1:2 with points linecolor rgb "#00ff7f0e" pointtype 7 pointsize 0.8 title "implicit-midpoint, energy-momentum", \
     "amplification.dat" index 14 using 1:2 with lines linecolor rgb "#005a5aa8" linewidth 1.6 notitle, \
     "amplification.dat" index 15 using 1:2 with points linecolor rgb "#005a5aa8" pointtype 11 pointsize 0.8 title "bdf2"
set title "implicit: numerical damping" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:1000]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [1e-08:10]
set ylabel "equivalent damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 16 using 1:2 with lines linecolor rgb "#007f7f7f" linewidth 1.6 notitle, \
     "amplification.dat" index 17 using 1:2 with points linecolor rgb "#007f7f7f" pointtype 5 pointsize 0.8 notitle, \
     "amplification.dat" index 18 using 1:2 with lines linecolor rgb "#009467bd" linewidth 1.6 notitle, \
     "amplification.dat" index 19 using 1:2 with points linecolor rgb "#009467bd" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 20 using 1:2 with lines linecolor rgb "#005a5aa8" linewidth 1.6 notitle, \
     "amplification.dat" index 21 using 1:2 with points linecolor rgb "#005a5aa8" pointtype 11 pointsize 0.8 notitle
set title "explicit: amplitude" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [0.80000000000000004:1.02]
set ylabel "amplitude after a step" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 22 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 1.6 notitle, \
     "amplification.dat" index 23 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 0.8 notitle, \
     "amplification.dat" index 24 using 1:2 with lines linecolor rgb "#00d62728" linewidth 1.6 notitle, \
     "amplification.dat" index 25 using 1:2 with points linecolor rgb "#00d62728" pointtype 5 pointsize 0.8 notitle, \
     "amplification.dat" index 26 using 1:2 with lines linecolor rgb "#002ca02c" linewidth 1.6 notitle, \
     "amplification.dat" index 27 using 1:2 with points linecolor rgb "#002ca02c" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 28 using 1:2 with lines linecolor rgb "#0017becf" linewidth 1.6 notitle, \
     "amplification.dat" index 29 using 1:2 with points linecolor rgb "#0017becf" pointtype 13 pointsize 0.8 notitle
set title "explicit: phase error" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:4]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [9.9999999999999998e-13:2]
set ylabel "|phase / (h omega) - 1|" noenhanced
set xtics autofreq
set ytics autofreq
set key bottom right Left reverse noenhanced samplen 1.5 font ",11"
plot "amplification.dat" index 30 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 1.6 notitle, \
     "amplification.dat" index 31 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 0.8 title "symplectic-euler, verlet", \
     "amplification.dat" index 32 using 1:2 with lines linecolor rgb "#00d62728" linewidth 1.6 notitle, \
     "amplification.dat" index 33 using 1:2 with points linecolor rgb "#00d62728" pointtype 5 pointsize 0.8 title "blanes-moan-4", \
     "amplification.dat" index 34 using 1:2 with lines linecolor rgb "#002ca02c" linewidth 1.6 notitle, \
     "amplification.dat" index 35 using 1:2 with points linecolor rgb "#002ca02c" pointtype 9 pointsize 0.8 title "rk4", \
     "amplification.dat" index 36 using 1:2 with lines linecolor rgb "#0017becf" linewidth 1.6 notitle, \
     "amplification.dat" index 37 using 1:2 with points linecolor rgb "#0017becf" pointtype 13 pointsize 0.8 title "dormand-prince-54"
set title "explicit: numerical damping" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:4]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [9.9999999999999998e-13:10]
set ylabel "equivalent damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 38 using 1:2 with lines linecolor rgb "#002ca02c" linewidth 1.6 notitle, \
     "amplification.dat" index 39 using 1:2 with points linecolor rgb "#002ca02c" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 40 using 1:2 with lines linecolor rgb "#0017becf" linewidth 1.6 notitle, \
     "amplification.dat" index 41 using 1:2 with points linecolor rgb "#0017becf" pointtype 13 pointsize 0.8 notitle
unset multiplot
unset output
set terminal svg size 2000,1100 font "DejaVu Sans,12" background rgb "white" enhanced
set output "amplification.svg"
set multiplot layout 2,3 rowsfirst margins 0.055,0.985,0.075,0.9 spacing 0.055,0.13 title "One step of an undamped oscillation: lines are closed forms, points are measured" noenhanced font ",17"
set title "implicit: amplitude" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:1000]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [0:1.05]
set ylabel "amplitude after a step" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 0 using 1:2 with lines linecolor rgb "#007f7f7f" linewidth 1.6 notitle, \
     "amplification.dat" index 1 using 1:2 with points linecolor rgb "#007f7f7f" pointtype 5 pointsize 0.8 notitle, \
     "amplification.dat" index 2 using 1:2 with lines linecolor rgb "#009467bd" linewidth 1.6 notitle, \
     "amplification.dat" index 3 using 1:2 with points linecolor rgb "#009467bd" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 4 using 1:2 with lines linecolor rgb "#00ff7f0e" linewidth 1.6 notitle, \
     "amplification.dat" index 5 using 1:2 with points linecolor rgb "#00ff7f0e" pointtype 7 pointsize 0.8 notitle, \
     "amplification.dat" index 6 using 1:2 with lines linecolor rgb "#005a5aa8" linewidth 1.6 notitle, \
     "amplification.dat" index 7 using 1:2 with points linecolor rgb "#005a5aa8" pointtype 11 pointsize 0.8 notitle
set title "implicit: phase error" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:1000]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [9.9999999999999995e-07:2]
set ylabel "|phase / (h omega) - 1|" noenhanced
set xtics autofreq
set ytics autofreq
set key bottom right Left reverse noenhanced samplen 1.5 font ",11"
plot "amplification.dat" index 8 using 1:2 with lines linecolor rgb "#007f7f7f" linewidth 1.6 notitle, \
     "amplification.dat" index 9 using 1:2 with points linecolor rgb "#007f7f7f" pointtype 5 pointsize 0.8 title "backward-euler, baraff-witkin, local-global", \
     "amplification.dat" index 10 using 1:2 with lines linecolor rgb "#009467bd" linewidth 1.6 notitle, \
     "amplification.dat" index 11 using 1:2 with points linecolor rgb "#009467bd" pointtype 9 pointsize 0.8 title "ros2, sdirk2", \
     "amplification.dat" index 12 using 1:2 with lines linecolor rgb "#00ff7f0e" linewidth 1.6 notitle, \
     "amplification.dat" index 13 using 1:2 with points linecolor rgb "#00ff7f0e" pointtype 7 pointsize 0.8 title "implicit-midpoint, energy-momentum", \
     "amplification.dat" index 14 using 1:2 with lines linecolor rgb "#005a5aa8" linewidth 1.6 notitle, \
     "amplification.dat" index 15 using 1:2 with points linecolor rgb "#005a5aa8" pointtype 11 pointsize 0.8 title "bdf2"
set title "implicit: numerical damping" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:1000]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [1e-08:10]
set ylabel "equivalent damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 16 using 1:2 with lines linecolor rgb "#007f7f7f" linewidth 1.6 notitle, \
     "amplification.dat" index 17 using 1:2 with points linecolor rgb "#007f7f7f" pointtype 5 pointsize 0.8 notitle, \
     "amplification.dat" index 18 using 1:2 with lines linecolor rgb "#009467bd" linewidth 1.6 notitle, \
     "amplification.dat" index 19 using 1:2 with points linecolor rgb "#009467bd" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 20 using 1:2 with lines linecolor rgb "#005a5aa8" linewidth 1.6 notitle, \
     "amplification.dat" index 21 using 1:2 with points linecolor rgb "#005a5aa8" pointtype 11 pointsize 0.8 notitle
set title "explicit: amplitude" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:4]
set xlabel "h omega" noenhanced
unset logscale y
set format y "%g"
set yrange [0.80000000000000004:1.02]
set ylabel "amplitude after a step" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 22 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 1.6 notitle, \
     "amplification.dat" index 23 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 0.8 notitle, \
     "amplification.dat" index 24 using 1:2 with lines linecolor rgb "#00d62728" linewidth 1.6 notitle, \
     "amplification.dat" index 25 using 1:2 with points linecolor rgb "#00d62728" pointtype 5 pointsize 0.8 notitle, \
     "amplification.dat" index 26 using 1:2 with lines linecolor rgb "#002ca02c" linewidth 1.6 notitle, \
     "amplification.dat" index 27 using 1:2 with points linecolor rgb "#002ca02c" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 28 using 1:2 with lines linecolor rgb "#0017becf" linewidth 1.6 notitle, \
     "amplification.dat" index 29 using 1:2 with points linecolor rgb "#0017becf" pointtype 13 pointsize 0.8 notitle
set title "explicit: phase error" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:4]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [9.9999999999999998e-13:2]
set ylabel "|phase / (h omega) - 1|" noenhanced
set xtics autofreq
set ytics autofreq
set key bottom right Left reverse noenhanced samplen 1.5 font ",11"
plot "amplification.dat" index 30 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 1.6 notitle, \
     "amplification.dat" index 31 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 0.8 title "symplectic-euler, verlet", \
     "amplification.dat" index 32 using 1:2 with lines linecolor rgb "#00d62728" linewidth 1.6 notitle, \
     "amplification.dat" index 33 using 1:2 with points linecolor rgb "#00d62728" pointtype 5 pointsize 0.8 title "blanes-moan-4", \
     "amplification.dat" index 34 using 1:2 with lines linecolor rgb "#002ca02c" linewidth 1.6 notitle, \
     "amplification.dat" index 35 using 1:2 with points linecolor rgb "#002ca02c" pointtype 9 pointsize 0.8 title "rk4", \
     "amplification.dat" index 36 using 1:2 with lines linecolor rgb "#0017becf" linewidth 1.6 notitle, \
     "amplification.dat" index 37 using 1:2 with points linecolor rgb "#0017becf" pointtype 13 pointsize 0.8 title "dormand-prince-54"
set title "explicit: numerical damping" noenhanced font ",13" offset 0,-0.5
set logscale x
set format x "10^{%T}"
set xrange [0.01:4]
set xlabel "h omega" noenhanced
set logscale y
set format y "10^{%T}"
set yrange [9.9999999999999998e-13:10]
set ylabel "equivalent damping ratio" noenhanced
set xtics autofreq
set ytics autofreq
unset key
plot "amplification.dat" index 38 using 1:2 with lines linecolor rgb "#002ca02c" linewidth 1.6 notitle, \
     "amplification.dat" index 39 using 1:2 with points linecolor rgb "#002ca02c" pointtype 9 pointsize 0.8 notitle, \
     "amplification.dat" index 40 using 1:2 with lines linecolor rgb "#0017becf" linewidth 1.6 notitle, \
     "amplification.dat" index 41 using 1:2 with points linecolor rgb "#0017becf" pointtype 13 pointsize 0.8 notitle
unset multiplot
unset output

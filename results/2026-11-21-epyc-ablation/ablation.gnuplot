set encoding utf8
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xrange [0.88702443371233397:4.8887489755939084]
set yrange [0.5:9.5]
set title "What a feature costs: on from a bare scene, off from a full one - interval over processes;\nbytes per tetrahedron" font ",15" noenhanced offset 0,0.3
set xlabel "time per step with it, over that without" font ",14" noenhanced
set ylabel "" font ",14" noenhanced offset -0.5,0
set tics out nomirror
set border 3 linewidth 1.2 linecolor rgb "#404040"
set mxtics 10
set mytics 10
set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb "#e4e4e4"
set key outside right top vertical Left reverse noenhanced samplen 2.2 spacing 1.25 font ",12"
set datafile separator whitespace
unset logscale y
unset mytics
set ytics ("rk4 for verlet" 1, "diagnostics" 2, "frames" 3, "stress watch" 4, "map" 5, "fixed vertices" 6, "gravity" 7, "viscosity" 8, "damping" 9) noenhanced
set format x "%g"
unset mxtics
set xtics (0.1, 0.2, 0.5, 0.8, 0.9, 1, 1.1, 1.25, 1.5, 2, 3, 5, 10, 20, 50, 100)
set terminal pngcairo size 1400,900 font "DejaVu Sans,12" background rgb "white"
set output "ablation.png"
plot "ablation.dat" index 0 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 0 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 1 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 1 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 2 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 3 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 3 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 4 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 4 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 5 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 5 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 6 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 7 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 8 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 8 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 9 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 9 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 10 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 11 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 12 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 12 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 13 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 13 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 14 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 14 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 15 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 16 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 17 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 17 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 18 using 1:2 with lines linecolor rgb "#00404040" linewidth 1 notitle, \
     "ablation.dat" index 19 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 1.4 title "on, from bare", \
     "ablation.dat" index 20 using 1:2 with points linecolor rgb "#00d62728" pointtype 5 pointsize 1.4 title "off, from full"
unset output
set terminal svg size 1400,900 font "DejaVu Sans,12" background rgb "white" enhanced
set output "ablation.svg"
plot "ablation.dat" index 0 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 0 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 1 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 1 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 2 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 3 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 3 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 4 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 4 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 5 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 5 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 6 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 7 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 8 using 1:2 with lines linecolor rgb "#001f77b4" linewidth 2 notitle, \
     "ablation.dat" index 8 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#001f77b4" notitle, \
     "ablation.dat" index 9 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 9 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 10 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 11 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 12 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 12 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 13 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 13 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 14 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 14 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 15 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 16 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 17 using 1:2 with lines linecolor rgb "#00d62728" linewidth 2 notitle, \
     "ablation.dat" index 17 using 1:2:3 with labels offset 0.8,0 left noenhanced font ",9" textcolor rgb "#00d62728" notitle, \
     "ablation.dat" index 18 using 1:2 with lines linecolor rgb "#00404040" linewidth 1 notitle, \
     "ablation.dat" index 19 using 1:2 with points linecolor rgb "#001f77b4" pointtype 7 pointsize 1.4 title "on, from bare", \
     "ablation.dat" index 20 using 1:2 with points linecolor rgb "#00d62728" pointtype 5 pointsize 1.4 title "off, from full"
unset output

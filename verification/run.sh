P=/work/prog3/bin/plastron
for c in "$@"; do n=$(basename $c .toml); /usr/bin/time -f "%U+%S s" $P run $n.toml --output /tmp/hm/$n --no-report --threads 1 -q --set model.check=false 2>/tmp/hm/$n.log; grep -v warning /tmp/hm/$n.log | tail -4;  python3 - $n <<'P'
import json,sys
r=json.load(open(f'/tmp/hm/{sys.argv[1]}/results.json'))
print('##',sys.argv[1],r['status'],r['levels'][-1]['unknowns'])
for g in r['estimates']['goals']: print('  ',g['name'],g['value'],'+-',g['error'],g['geometry_error'], 'tol',g['tolerance'])
for k,p in r['probes'].items(): print('  ',k,p['u'],'I',p['principal_stress_lower'], p['stress_middle'])
for m in r['modes'][:12]: print('   ',m)
P
done

<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
 <context>
  <name>Bladesmith</name>
  <message>
   <source>A scale needs two numbers, the smaller one first, and both above zero where it is logarithmic.</source>
   <translation>Eine Skala braucht zwei Zahlen, die kleinere zuerst, und beide über null, wo sie logarithmisch ist.</translation>
  </message>
  <message>
   <source>All files</source>
   <translation>Alle Dateien</translation>
  </message>
  <message>
   <source>Angle, °</source>
   <translation>Winkel, °</translation>
  </message>
  <message>
   <source>Automatic scale</source>
   <translation>Automatische Skala</translation>
  </message>
  <message>
   <source>Checking …</source>
   <translation>Wird geprüft …</translation>
  </message>
  <message>
   <source>Choose a file</source>
   <translation>Datei wählen</translation>
  </message>
  <message>
   <source>Choose a file with displacements, or a result of the FEM workbench.</source>
   <translation>Eine Datei mit Verschiebungen oder ein Ergebnis des FEM-Arbeitsbereichs wählen.</translation>
  </message>
  <message>
   <source>Colours</source>
   <translation>Farben</translation>
  </message>
  <message>
   <source>Deviation</source>
   <translation>Abweichung</translation>
  </message>
  <message>
   <source>Displacement</source>
   <translation>Verschiebung</translation>
  </message>
  <message>
   <source>Displacement X</source>
   <translation>Verschiebung X</translation>
  </message>
  <message>
   <source>Displacement Y</source>
   <translation>Verschiebung Y</translation>
  </message>
  <message>
   <source>Displacement Z</source>
   <translation>Verschiebung Z</translation>
  </message>
  <message>
   <source>Displacements</source>
   <translation>Verschiebungen</translation>
  </message>
  <message>
   <source>Drawing the report …</source>
   <translation>Bericht wird gezeichnet …</translation>
  </message>
  <message>
   <source>Edge</source>
   <translation>Kante</translation>
  </message>
  <message>
   <source>Edges of the input</source>
   <translation>Kanten der Eingabe</translation>
  </message>
  <message>
   <source>Enlarged</source>
   <translation>Vergrößert</translation>
  </message>
  <message>
   <source>Faces</source>
   <translation>Flächen</translation>
  </message>
  <message>
   <source>Faces without nodes: {0}</source>
   <translation>Flächen ohne Knoten: {0}</translation>
  </message>
  <message>
   <source>Face{0}, node {1}</source>
   <translation>Face{0}, Knoten {1}</translation>
  </message>
  <message>
   <source>Factor {0}</source>
   <translation>Faktor {0}</translation>
  </message>
  <message>
   <source>From</source>
   <translation>Von</translation>
  </message>
  <message>
   <source>Gap before, µm</source>
   <translation>Spalt vorher, µm</translation>
  </message>
  <message>
   <source>Gap, µm</source>
   <translation>Spalt, µm</translation>
  </message>
  <message>
   <source>Gaps and tangency by edge</source>
   <translation>Spalte und Tangentialität je Kante</translation>
  </message>
  <message>
   <source>Hold-out error: mean {0} mm, largest {1} mm, on {2}</source>
   <translation>Fehler an zurückgehaltenen Knoten: Mittel {0} mm, größter {1} mm, auf {2}</translation>
  </message>
  <message>
   <source>How much the angle of a tangent joint grew</source>
   <translation>Um wie viel sich ein tangentialer Übergang geöffnet hat</translation>
  </message>
  <message>
   <source>Input</source>
   <translation>Eingabe</translation>
  </message>
  <message>
   <source>Largest angle between the normals of both faces</source>
   <translation>Größter Winkel zwischen den Normalen beider Flächen</translation>
  </message>
  <message>
   <source>Largest deviation {0} mm, on {1}: beyond the tolerance of {2} mm</source>
   <translation>Größte Abweichung {0} mm, auf {1}: außerhalb der Toleranz von {2} mm</translation>
  </message>
  <message>
   <source>Largest deviation {0} mm, on {1}: within the tolerance of {2} mm</source>
   <translation>Größte Abweichung {0} mm, auf {1}: innerhalb der Toleranz von {2} mm</translation>
  </message>
  <message>
   <source>Largest displacement {0} at node {1} ({2})</source>
   <translation>Größte Verschiebung {0} am Knoten {1} ({2})</translation>
  </message>
  <message>
   <source>Largest distance among its curve and its traces on both faces</source>
   <translation>Größter Abstand zwischen der Kurve und ihren Spuren auf beiden Flächen</translation>
  </message>
  <message>
   <source>Largest gap {0} mm, at Edge{1}; {2} mm before</source>
   <translation>Größter Spalt {0} mm, an Edge{1}; vorher {2} mm</translation>
  </message>
  <message>
   <source>Length unit:</source>
   <translation>Längeneinheit:</translation>
  </message>
  <message>
   <source>Logarithmic</source>
   <translation>Logarithmisch</translation>
  </message>
  <message>
   <source>Mark the worst spot</source>
   <translation>Schlechteste Stelle markieren</translation>
  </message>
  <message>
   <source>Mesh</source>
   <translation>Netz</translation>
  </message>
  <message>
   <source>Movement</source>
   <translation>Bewegung</translation>
  </message>
  <message>
   <source>Open report</source>
   <translation>Bericht öffnen</translation>
  </message>
  <message>
   <source>Opened, °</source>
   <translation>Geöffnet, °</translation>
  </message>
  <message>
   <source>Result</source>
   <translation>Ergebnis</translation>
  </message>
  <message>
   <source>Result of a morph</source>
   <translation>Ergebnis eines Morphs</translation>
  </message>
  <message>
   <source>Scale</source>
   <translation>Maßstab</translation>
  </message>
  <message>
   <source>Shape</source>
   <translation>Form</translation>
  </message>
  <message>
   <source>Steps</source>
   <translation>Stufen</translation>
  </message>
  <message>
   <source>Stopped; the object stays as it was.</source>
   <translation>Abgebrochen; das Objekt bleibt, wie es war.</translation>
  </message>
  <message>
   <source>The faces that it joins</source>
   <translation>Die Flächen, die sie verbindet</translation>
  </message>
  <message>
   <source>The gap of the input</source>
   <translation>Der Spalt der Eingabe</translation>
  </message>
  <message>
   <source>The input has changed since. The result before the change:</source>
   <translation>Die Eingaben haben sich seither geändert. Das Ergebnis davor:</translation>
  </message>
  <message>
   <source>The result is folded: not to be used</source>
   <translation>Das Ergebnis ist gefaltet: nicht verwenden</translation>
  </message>
  <message>
   <source>The solid is not valid, or open</source>
   <translation>Der Körper ist ungültig oder offen</translation>
  </message>
  <message>
   <source>The solid is valid and closed</source>
   <translation>Der Körper ist gültig und geschlossen</translation>
  </message>
  <message>
   <source>Warning: {0}</source>
   <translation>Warnung: {0}</translation>
  </message>
  <message>
   <source>Zoom</source>
   <translation>Zoomen</translation>
  </message>
  <message>
   <source>Zoom to the chosen edge</source>
   <translation>Auf die gewählte Kante zoomen</translation>
  </message>
  <message>
   <source>a file</source>
   <translation>einer Datei</translation>
  </message>
  <message>
   <source>a larger value at Match within</source>
   <translation>einen größeren Wert bei Zuordnen bis</translation>
  </message>
  <message>
   <source>a morph needs at least {0} that do not lie in one line</source>
   <translation>ein Morph braucht mindestens {0}, die nicht auf einer Geraden liegen</translation>
  </message>
  <message>
   <source>a tick at Extrapolate</source>
   <translation>ein Häkchen bei Extrapolieren</translation>
  </message>
  <message>
   <source>all displacements are zero: the result equals the input</source>
   <translation>Alle Verschiebungen sind null: das Ergebnis gleicht der Eingabe</translation>
  </message>
  <message>
   <source>areas without nodes on {0}, {1} mm² in all: {2}; give --extrapolate to extend the field over them</source>
   <translation>Bereiche ohne Knoten auf {0}, zusammen {1} mm²: {2}; um das Feld dorthin fortzusetzen, angeben: --extrapolate</translation>
  </message>
  <message>
   <source>beside held faces</source>
   <translation>neben festgehaltenen Flächen</translation>
  </message>
  <message>
   <source>cold to hot</source>
   <translation>kalt nach heiß</translation>
  </message>
  <message>
   <source>drawing</source>
   <translation>Darstellung</translation>
  </message>
  <message>
   <source>edges gape by up to {0} mm: {1}</source>
   <translation>Kanten klaffen um bis zu {0} mm: {1}</translation>
  </message>
  <message>
   <source>elsewhere</source>
   <translation>anderswo</translation>
  </message>
  <message>
   <source>empty knot spans: {0} of {1} on {2}: their poles follow the regularisation alone</source>
   <translation>Leere Knotenspannen: {0} von {1} auf {2}: ihre Pole folgen allein der Regularisierung</translation>
  </message>
  <message>
   <source>fitting all faces together</source>
   <translation>alle Flächen gemeinsam anpassen</translation>
  </message>
  <message>
   <source>fitting each face</source>
   <translation>jede Fläche anpassen</translation>
  </message>
  <message>
   <source>fitting without every tenth node</source>
   <translation>ohne jeden zehnten Knoten anpassen</translation>
  </message>
  <message>
   <source>hot to cold</source>
   <translation>heiß nach kalt</translation>
  </message>
  <message>
   <source>measuring the result</source>
   <translation>Ergebnis vermessen</translation>
  </message>
  <message>
   <source>mm, assumed</source>
   <translation>mm, angenommen</translation>
  </message>
  <message>
   <source>movement × {0}</source>
   <translation>Bewegung × {0}</translation>
  </message>
  <message>
   <source>nothing moves</source>
   <translation>nichts bewegt sich</translation>
  </message>
  <message>
   <source>placing nodes on faces</source>
   <translation>Knoten den Flächen zuordnen</translation>
  </message>
  <message>
   <source>rebuilding the solid</source>
   <translation>Körper neu aufbauen</translation>
  </message>
  <message>
   <source>smooth</source>
   <translation>stufenlos</translation>
  </message>
  <message>
   <source>step {0} of {1}</source>
   <translation>Schritt {0} von {1}</translation>
  </message>
  <message>
   <source>tangent joints open by up to {0}° {1}: edges {2}</source>
   <translation>Tangentiale Übergänge öffnen sich um bis zu {0}° {1}: Kanten {2}</translation>
  </message>
  <message>
   <source>the displacement was computed on the given shape and taken away from it: the result is a first-order estimate of the unloaded shape; the second-order term |∇u|·|u| reaches about {0} mm</source>
   <translation>Die Verschiebung wurde an der gegebenen Form berechnet und von ihr weggenommen: das Ergebnis ist eine Schätzung erster Ordnung der unbelasteten Form; das Glied zweiter Ordnung |∇u|·|u| erreicht etwa {0} mm</translation>
  </message>
  <message>
   <source>the field has no elements: {0} of {1} nodes lie on the faces, the others are taken as inside</source>
   <translation>Das Feld hat keine Elemente: {0} von {1} Knoten liegen auf den Flächen, die anderen gelten als innere</translation>
  </message>
  <message>
   <source>the field holds {0} still; its gradient jumps at the edges there</source>
   <translation>Das Feld hält {0} fest; sein Gradient springt dort an den Kanten</translation>
  </message>
  <message>
   <source>the largest displacement, {0} mm, is {1} times the part's size ({2} mm): the solid would be folded; check the unit of the displacements (--displacement-scale scales them alone) and the factor</source>
   <translation>Die größte Verschiebung, {0} mm, ist {1} mal so groß wie das Teil ({2} mm): der Körper würde gefaltet; Einheit der Verschiebungen (--displacement-scale skaliert nur sie) und Faktor prüfen</translation>
  </message>
  <message>
   <source>to</source>
   <translation>bis</translation>
  </message>
  <message>
   <source>{0} nodes lie on the part, within {1} mm</source>
   <translation>{0} Knoten liegen auf dem Teil, auf {1} mm genau</translation>
  </message>
  <message>
   <source>{0} nodes of the mesh's surface lie on no face</source>
   <translation>{0} Knoten der Netzoberfläche liegen auf keiner Fläche</translation>
  </message>
  <message>
   <source>{0} of {1} surface nodes lie on no face within {2} mm and are not used (ids {3})</source>
   <translation>{0} von {1} Oberflächenknoten liegen auf keiner Fläche innerhalb von {2} mm und werden nicht verwendet (Nummern {3})</translation>
  </message>
  <message>
   <source>{0} of {1} tangent joints opened</source>
   <translation>{0} von {1} tangentialen Übergängen haben sich geöffnet</translation>
  </message>
  <message>
   <source>{0}: a deck (.inp) has a mesh but no displacements: give the results of its run (.frd) here, and the deck as their mesh</source>
   <translation>{0}: ein Deck (.inp) hat ein Netz, aber keine Verschiebungen: hier die Ergebnisse seiner Rechnung (.frd) angeben und das Deck als ihr Netz</translation>
  </message>
  <message>
   <source>{0}: only {1} with a displacement: {2}</source>
   <translation>{0}: nur {1} mit Verschiebung: {2}</translation>
  </message>
  <message>
   <source>{0}: the FE model does not lie on the geometry of {1}: {2} of {3} nodes are within {4} mm, the median distance is {5} mm; check that both are in the same place, orientation (not mirrored) and unit, or give --match-tolerance</source>
   <translation>{0}: das FE-Modell liegt nicht auf der Geometrie von {1}: {2} von {3} Knoten liegen näher als {4} mm, der mittlere Abstand (Median) ist {5} mm; prüfen, ob beide am selben Ort, gleich ausgerichtet (nicht gespiegelt) und in derselben Einheit sind, oder angeben: --match-tolerance</translation>
  </message>
  <message>
   <source>{0}: the mesh measures {1} and the part {2} mm, a ratio of {3}: the field seems to be in {4}; give {5}</source>
   <translation>{0}: das Netz misst {1} und das Teil {2} mm, ein Verhältnis von {3}: das Feld scheint in {4} zu sein; angeben: {5}</translation>
  </message>
  <message>
   <source>{0}: the {1} nodes with a displacement lie in one line: {2}</source>
   <translation>{0}: die {1} Knoten mit Verschiebung liegen auf einer Geraden: {2}</translation>
  </message>
  <message>
   <source>{0}: {1} nodes with a displacement, {2}</source>
   <translation>{0}: {1} Knoten mit Verschiebung, {2}</translation>
  </message>
 </context>
 <context>
  <name>BladesmithPreferences</name>
  <message>
   <source>-1 takes the displacements away, 1 adds them</source>
   <translation>-1 nimmt die Verschiebungen weg, 1 fügt sie hinzu</translation>
  </message>
  <message>
   <source>Factor of a new morph</source>
   <translation>Faktor eines neuen Morphs</translation>
  </message>
  <message>
   <source>General</source>
   <translation>Allgemein</translation>
  </message>
  <message>
   <source>Largest deviation at a node that counts as success</source>
   <translation>Größte Abweichung an einem Knoten, die noch als Erfolg gilt</translation>
  </message>
  <message>
   <source>Morph</source>
   <translation>Morphen</translation>
  </message>
  <message>
   <source>Show a new result</source>
   <translation>Neues Ergebnis zeigen</translation>
  </message>
  <message>
   <source>The result does not depend on it</source>
   <translation>Das Ergebnis hängt nicht davon ab</translation>
  </message>
  <message>
   <source>Threads</source>
   <translation>Threads</translation>
  </message>
  <message>
   <source>Tolerance of a new morph, mm</source>
   <translation>Toleranz eines neuen Morphs, mm</translation>
  </message>
  <message>
   <source>Where the source stays to be seen</source>
   <translation>Wo die Quelle zu sehen bleibt</translation>
  </message>
  <message>
   <source>all processors</source>
   <translation>alle Prozessoren</translation>
  </message>
  <message>
   <source>alone</source>
   <translation>allein</translation>
  </message>
  <message>
   <source>beside its source</source>
   <translation>neben seiner Quelle</translation>
  </message>
  <message>
   <source>over its source</source>
   <translation>über seiner Quelle</translation>
  </message>
 </context>
 <context>
  <name>Bladesmith_ExportStep</name>
  <message>
   <source>Export STEP with names</source>
   <translation>STEP mit Namen exportieren</translation>
  </message>
  <message>
   <source>Writes the selected solid as STEP; names and colours of faces are kept</source>
   <translation>Schreibt den ausgewählten Körper als STEP; Namen und Farben der Flächen bleiben erhalten</translation>
  </message>
 </context>
 <context>
  <name>Bladesmith_ImportStep</name>
  <message>
   <source>Import STEP with names</source>
   <translation>STEP mit Namen importieren</translation>
  </message>
  <message>
   <source>Reads solids from a STEP file; names and colours of faces are kept</source>
   <translation>Liest Körper aus einer STEP-Datei; Namen und Farben der Flächen bleiben erhalten</translation>
  </message>
 </context>
 <context>
  <name>Bladesmith_Morph</name>
  <message>
   <source>Morph</source>
   <translation>Morphen</translation>
  </message>
  <message>
   <source>Moves a solid by the displacements of a finite-element analysis</source>
   <translation>Bewegt einen Körper um die Verschiebungen einer Finite-Elemente-Rechnung</translation>
  </message>
 </context>
 <context>
  <name>Bladesmith_OpenReport</name>
  <message>
   <source>Open report</source>
   <translation>Bericht öffnen</translation>
  </message>
  <message>
   <source>Opens the page about a morph: verdict, figures and pictures</source>
   <translation>Öffnet die Seite über einen Morph: Urteil, Zahlen und Bilder</translation>
  </message>
 </context>
 <context>
  <name>Bladesmith_ShowResult</name>
  <message>
   <source>Show result</source>
   <translation>Ergebnis zeigen</translation>
  </message>
  <message>
   <source>Shows displacement and deviation as colours, and the joints edge by edge</source>
   <translation>Zeigt Verschiebung und Abweichung als Farben und die Übergänge Kante für Kante</translation>
  </message>
 </context>
 <context>
  <name>MorphPanel</name>
  <message>
   <source>0 chooses from the size</source>
   <translation>0 wählt nach der Größe</translation>
  </message>
  <message>
   <source>1 adds the displacements, -1 takes them away</source>
   <translation>1 fügt die Verschiebungen hinzu, -1 nimmt sie weg</translation>
  </message>
  <message>
   <source>1 adds the displacements, -1 takes them away (hot to cold)</source>
   <translation>1 fügt die Verschiebungen hinzu, -1 nimmt sie weg (heiß nach kalt)</translation>
  </message>
  <message>
   <source>A file, or a result of the FEM workbench</source>
   <translation>Eine Datei oder ein Ergebnis des FEM-Arbeitsbereichs</translation>
  </message>
  <message>
   <source>A further factor on the displacements alone, as for a file with mixed units</source>
   <translation>Ein weiterer Faktor auf die Verschiebungen allein, etwa für eine Datei mit gemischten Einheiten</translation>
  </message>
  <message>
   <source>A second fit that does not see a tenth of the nodes tells the error between nodes</source>
   <translation>Eine zweite Anpassung, die ein Zehntel der Knoten nicht sieht, zeigt den Fehler zwischen den Knoten</translation>
  </message>
  <message>
   <source>Also fit without a tenth of the nodes</source>
   <translation>Auch ohne ein Zehntel der Knoten anpassen</translation>
  </message>
  <message>
   <source>Choose a file</source>
   <translation>Datei wählen</translation>
  </message>
  <message>
   <source>Computes the result; the panel stays open</source>
   <translation>Berechnet das Ergebnis; das Fenster bleibt offen</translation>
  </message>
  <message>
   <source>Displacement and deviation as colours</source>
   <translation>Verschiebung und Abweichung als Farben</translation>
  </message>
  <message>
   <source>Displacements</source>
   <translation>Verschiebungen</translation>
  </message>
  <message>
   <source>Displacements: CalculiX .frd or CSV, gzipped or not</source>
   <translation>Verschiebungen: CalculiX .frd oder CSV, auch mit gzip gepackt</translation>
  </message>
  <message>
   <source>Ends the work; the object stays as it was</source>
   <translation>Beendet die Rechnung; das Objekt bleibt, wie es war</translation>
  </message>
  <message>
   <source>Extend the field over areas without nodes, however far</source>
   <translation>Das Feld über Bereiche ohne Knoten fortsetzen, wie weit es auch sei</translation>
  </message>
  <message>
   <source>Extrapolate</source>
   <translation>Extrapolieren</translation>
  </message>
  <message>
   <source>Factor</source>
   <translation>Faktor</translation>
  </message>
  <message>
   <source>Field file</source>
   <translation>Felddatei</translation>
  </message>
  <message>
   <source>Fit</source>
   <translation>Anpassung</translation>
  </message>
  <message>
   <source>From</source>
   <translation>Aus</translation>
  </message>
  <message>
   <source>Hold</source>
   <translation>Festhalten</translation>
  </message>
  <message>
   <source>Hold-out test</source>
   <translation>Rückhalteprobe</translation>
  </message>
  <message>
   <source>How far a node may lie off the part; 0 chooses from its size</source>
   <translation>Wie weit ein Knoten neben dem Teil liegen darf; 0 wählt nach dessen Größe</translation>
  </message>
  <message>
   <source>Largest deviation at a node that counts as success</source>
   <translation>Größte Abweichung an einem Knoten, die noch als Erfolg gilt</translation>
  </message>
  <message>
   <source>Largest deviation that counts as success</source>
   <translation>Größte Abweichung, die noch als Erfolg gilt</translation>
  </message>
  <message>
   <source>Length unit</source>
   <translation>Längeneinheit</translation>
  </message>
  <message>
   <source>Length unit of the field</source>
   <translation>Längeneinheit des Feldes</translation>
  </message>
  <message>
   <source>Length unit of the field; if not stated, millimetres, and refused where its size shows another</source>
   <translation>Längeneinheit des Feldes; ohne Angabe Millimeter, und abgelehnt, wo die Größe eine andere zeigt</translation>
  </message>
  <message>
   <source>Match within</source>
   <translation>Zuordnen bis</translation>
  </message>
  <message>
   <source>Mesh file</source>
   <translation>Netzdatei</translation>
  </message>
  <message>
   <source>Morph</source>
   <translation>Morphen</translation>
  </message>
  <message>
   <source>Move areas far from any node too</source>
   <translation>Auch Bereiche fern von allen Knoten bewegen</translation>
  </message>
  <message>
   <source>Move only</source>
   <translation>Nur bewegen</translation>
  </message>
  <message>
   <source>Names or numbers of faces, by commas</source>
   <translation>Namen oder Nummern von Flächen, durch Kommas getrennt</translation>
  </message>
  <message>
   <source>On the displacements alone</source>
   <translation>Auf die Verschiebungen allein</translation>
  </message>
  <message>
   <source>Only these faces move</source>
   <translation>Nur diese Flächen bewegen sich</translation>
  </message>
  <message>
   <source>Open report</source>
   <translation>Bericht öffnen</translation>
  </message>
  <message>
   <source>Part</source>
   <translation>Teil</translation>
  </message>
  <message>
   <source>Result</source>
   <translation>Ergebnis</translation>
  </message>
  <message>
   <source>Result step of the file</source>
   <translation>Ergebnisschritt der Datei</translation>
  </message>
  <message>
   <source>Scale</source>
   <translation>Maßstab</translation>
  </message>
  <message>
   <source>Show result</source>
   <translation>Ergebnis zeigen</translation>
  </message>
  <message>
   <source>Solid</source>
   <translation>Körper</translation>
  </message>
  <message>
   <source>Solid of a source with several</source>
   <translation>Körper einer Quelle mit mehreren</translation>
  </message>
  <message>
   <source>Source</source>
   <translation>Quelle</translation>
  </message>
  <message>
   <source>Step</source>
   <translation>Schritt</translation>
  </message>
  <message>
   <source>Stop</source>
   <translation>Abbrechen</translation>
  </message>
  <message>
   <source>Take</source>
   <translation>Holen</translation>
  </message>
  <message>
   <source>Take the faces that are selected in the 3-D view</source>
   <translation>Die in der 3-D-Ansicht ausgewählten Flächen übernehmen</translation>
  </message>
  <message>
   <source>The deck the field was solved on</source>
   <translation>Das Netz, auf dem gerechnet wurde</translation>
  </message>
  <message>
   <source>The deck the field was solved on: an .frd keeps six digits only</source>
   <translation>Das Netz, auf dem gerechnet wurde: eine .frd behält nur sechs Stellen</translation>
  </message>
  <message>
   <source>The object whose solid is morphed</source>
   <translation>Das Objekt, dessen Körper gemorpht wird</translation>
  </message>
  <message>
   <source>The page with all figures and pictures</source>
   <translation>Die Seite mit allen Zahlen und Bildern</translation>
  </message>
  <message>
   <source>These faces stay where they are</source>
   <translation>Diese Flächen bleiben, wo sie sind</translation>
  </message>
  <message>
   <source>Tolerance</source>
   <translation>Toleranz</translation>
  </message>
  <message>
   <source>What the input holds</source>
   <translation>Was die Eingabe enthält</translation>
  </message>
  <message>
   <source>Which way the factor moves the part</source>
   <translation>In welche Richtung der Faktor das Teil bewegt</translation>
  </message>
  <message>
   <source>all faces</source>
   <translation>alle Flächen</translation>
  </message>
  <message>
   <source>automatic</source>
   <translation>automatisch</translation>
  </message>
  <message>
   <source>none</source>
   <translation>keine</translation>
  </message>
  <message>
   <source>the covered one</source>
   <translation>der abgedeckte</translation>
  </message>
  <message>
   <source>the last</source>
   <translation>der letzte</translation>
  </message>
  <message>
   <source>…</source>
   <translation>…</translation>
  </message>
 </context>
</TS>
